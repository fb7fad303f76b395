// Where the areas of the process image lie, which an application would say: 4096 bytes each, one
// after the other.
#include "runtime/iec/image.h"

namespace st {

const ::stride::ULINT image__i__at__ = 0;
const ::stride::ULINT image__q__at__ = 4096;
const ::stride::ULINT image__m__at__ = 2 * 4096;

} // namespace st
