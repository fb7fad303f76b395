# The headers, which are the same for every processor.
if(NOT TARGET fmt::fmt)
  add_library(fmt::fmt INTERFACE IMPORTED)
endif()
set(fmt_FOUND TRUE)
