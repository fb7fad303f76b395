// "Did you mean": the names nearest to an unknown one.
#ifndef STRIDE_RUNTIME_APP_NEAREST_HPP
#define STRIDE_RUNTIME_APP_NEAREST_HPP

#include <string>
#include <string_view>
#include <vector>

namespace stride::app {

/// "; did you mean 'a', 'b' or 'c'?" with at most three near candidates, or an empty text.
std::string didYouMean(std::string_view name, const std::vector<std::string> &candidates);

} // namespace stride::app

#endif
