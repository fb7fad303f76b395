// The process image: located variables and direct addresses in generated code.
// Free of the C++ standard library; see types.h.
#ifndef STRIDE_RUNTIME_IEC_IMAGE_H
#define STRIDE_RUNTIME_IEC_IMAGE_H

#include "runtime/iec/ctx.h"
#include "runtime/iec/types.h"

/// Where the areas lie in the application's state; the application defines them.
namespace st {
extern const ::stride::ULINT image__i__at__;
extern const ::stride::ULINT image__q__at__;
extern const ::stride::ULINT image__m__at__;
} // namespace st

namespace stride {

#pragma pack(push, 1)
/// A value at any address.
template <class T> struct Unaligned { T v; };
#pragma pack(pop)

/// The bytes of an area.
inline BYTE *area(Ctx &ctx, uint64_t place) { return static_cast<BYTE *>(ctx.state) + place; }

/// The variable that begins with byte n of an area, at a multiple of its alignment.
template <class T> inline T &at(BYTE *area, uint64_t n) { return *reinterpret_cast<T *>(area + n); }
/// The same at any address; `.v` is the variable.
template <class T> inline Unaligned<T> &unaligned(BYTE *area, uint64_t n) {
  return *reinterpret_cast<Unaligned<T> *>(area + n);
}
/// A BOOL whose byte others may have written.
inline BOOL truth(BYTE x) { return static_cast<BOOL>(x != 0); }

/// Bit n of an area.
inline BOOL getBitAt(const BYTE *area, uint64_t n) {
  return static_cast<BOOL>((area[n >> 3U] >> (n & 7U)) & 1U);
}
inline void setBitAt(BYTE *area, uint64_t n, BOOL value) {
  const auto mask = static_cast<BYTE>(1U << (n & 7U));
  BYTE &byte = area[n >> 3U];
  byte = static_cast<BYTE>(value != 0 ? byte | mask : byte & ~mask);
}

} // namespace stride

#endif
