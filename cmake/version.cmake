# cmake -DSOURCE=… -DVERSION=… -DOUT=… -P version.cmake: writes the C++ source of stc::cli::versionText(), the version
# with the commit of the sources, if they are in a repository. Leaves it alone when it would not change.
find_program(git git)
set(commit "")
if(git)
  execute_process(COMMAND ${git} -C ${SOURCE} log -1 --format=%h,\ %cs --abbrev=12
    OUTPUT_VARIABLE commit ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed)
  execute_process(COMMAND ${git} -C ${SOURCE} status --porcelain --untracked-files=no
    OUTPUT_VARIABLE changed ERROR_QUIET)
  if(failed)
    set(commit "")
  elseif(NOT changed STREQUAL "")
    string(APPEND commit ", changed since")
  endif()
endif()
set(text "stride ${VERSION}")
if(NOT commit STREQUAL "")
  string(APPEND text " (${commit})")
endif()
file(CONFIGURE OUTPUT ${OUT} CONTENT "// Written by cmake/version.cmake.
#include \"compiler/cli/version.hpp\"

namespace stc::cli {

const char *versionText() { return \"${text}\"; }

} // namespace stc::cli
")
