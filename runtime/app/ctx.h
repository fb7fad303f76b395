// struct Ctx as applications include it. The definition lives below, in runtime/iec, because the
// checked operations there use it.
#ifndef STRIDE_RUNTIME_APP_CTX_H
#define STRIDE_RUNTIME_APP_CTX_H

#include "runtime/iec/ctx.h"

#endif
