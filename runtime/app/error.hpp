// What can go wrong with an application outside its cycles: loading, symbols, values.
#ifndef STRIDE_RUNTIME_APP_ERROR_HPP
#define STRIDE_RUNTIME_APP_ERROR_HPP

#include <stdexcept>
#include <string>

namespace stride::app {

/// A complete sentence for the user, without the prefix "error:". Never thrown inside a cycle.
class Error : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

} // namespace stride::app

#endif
