#ifndef STRIDE_COMPILER_DOC_HTML_HPP
#define STRIDE_COMPILER_DOC_HTML_HPP
// A reference as a folder of HTML pages that need no server.

#include "compiler/doc/reference.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace stc::doc {

/// One file of the reference.
struct Page {
  std::string path; ///< `index.html`, `SM_PLCopen.html`, `search.js` …
  std::string text;
};

/// An index, one page per module, a style sheet and the search. Names of entries link to them
/// wherever a text or a type mentions them; every link leads somewhere within the pages, or to the
/// figure of an entry, whose page is the caller's.
[[nodiscard]] std::vector<Page> htmlPages(const std::string &title,
                                          const std::vector<Module> &modules);

} // namespace stc::doc

#endif // STRIDE_COMPILER_DOC_HTML_HPP
