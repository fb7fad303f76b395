// VAR_INPUT x : BOOL R_EDGE (IEC 61131-3, table 40): inside of the block's body x is TRUE in the
// call in which it has become TRUE; F_EDGE: has become FALSE. Outside it keeps the value it was
// given. Free of the C++ standard library; see types.h.
#ifndef STRIDE_RUNTIME_IEC_EDGE_H
#define STRIDE_RUNTIME_IEC_EDGE_H

#include "runtime/iec/types.h"

namespace stride {

/// Makes the input the edge for as long as this object lives. `old`: its value in the last call.
class EdgeInput {
public:
  EdgeInput(BOOL &input, BOOL &old, bool rising) : input_(input), given_(input) {
    input = (rising ? given_ != 0 && old == 0 : given_ == 0 && old != 0) ? 1 : 0;
    old = given_;
  }
  ~EdgeInput() { input_ = given_; }
  EdgeInput(const EdgeInput &) = delete;
  EdgeInput &operator=(const EdgeInput &) = delete;

private:
  BOOL &input_;
  BOOL given_;
};

} // namespace stride

#endif // STRIDE_RUNTIME_IEC_EDGE_H
