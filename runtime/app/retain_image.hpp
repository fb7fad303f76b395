// The values of retained variables: taken from a state, as bytes of a file, put back into a state.
#ifndef STRIDE_RUNTIME_APP_RETAIN_IMAGE_HPP
#define STRIDE_RUNTIME_APP_RETAIN_IMAGE_HPP

#include "runtime/app/carry_over.hpp"
#include "runtime/app/error.hpp"
#include "runtime/app/retain_layout.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace stride::app {

/// Copies ranges of a state one after the other. For the cyclic path: allocates nothing, takes as
/// long as the bytes take. Values of up to 8 bytes at natural alignment are never torn, whoever
/// writes them.
void copyRetained(const std::byte *state, std::span<const RetainRange> ranges,
                  std::byte *to) noexcept;

/// What tells one image from another.
struct RetainHead {
  std::string application; ///< Its name.
  uint64_t buildHash = 0;  ///< Of the build that made it.
  uint64_t sequence = 0;   ///< The larger, the later.
};

/// One complete set of values.
struct RetainImage {
  RetainHead head;
  RetainLayout layout;
  std::vector<std::byte> values; ///< Of layout.ranges(), in their order.
};

/// As the bytes of a file: head, checksum, layout, values. `layout` is RetainLayout::encode().
std::vector<std::byte> encodeImage(const RetainHead &head, std::span<const std::byte> layout,
                                   std::span<const std::byte> values);

/// A file of another version of this format: to be kept, not to be overwritten.
class RetainVersionError : public Error {
public:
  using Error::Error;
};

/// Whether a file with these bytes may be an image, a part of one, or what a lost write has left of
/// one: it is empty, or begins as images do or with zeros.
bool mayBeImage(std::span<const std::byte> bytes);

/// Throws Error when the bytes are not a complete image, RetainVersionError when a newer Stride
/// wrote them. `checked` false: without comparing the checksum, for tests of what lies after it.
RetainImage decodeImage(std::span<const std::byte> bytes, bool checked = true);

/// The image without RETAIN variables that are not PERSISTENT (cold), or without all (origin).
RetainImage withoutRetains(const RetainImage &image, uint32_t keep);

/// What became of the stored values.
struct RetainReport {
  uint64_t kept = 0;              ///< Elementary values.
  std::vector<std::string> lost;  ///< "Main.x is not restored: …", by path.
  std::vector<std::string> notes; ///< Kept under another name or in another type.
};

/// Puts an image into the state of a build. The same build takes everything; another one, which is
/// a download in the words of CODESYS, what it declares PERSISTENT, matched by path and type.
class RetainRestore {
public:
  /// All three live as long as this.
  RetainRestore(const StrideAppV1 &app, const RetainLayout &layout, const RetainImage &image);

  /// The build is the same and everything it retains is in the image: FB_Init is told bInitRetains
  /// := FALSE (Ctx::keepRetains).
  bool keepsRetains() const { return keepsRetains_; }
  bool sameBuild() const { return sameBuild_; }

  /// After initialisation, before the first cycle.
  RetainReport apply(std::byte *state) const;

private:
  class Losses;
  void explain(RetainReport &report) const;

  const StrideAppV1 *app_;
  const RetainImage *image_;
  bool sameBuild_;
  bool keepsRetains_;
  RetainLayout wanted_;
  RetainLayout stored_; ///< As the image's; native blocks of another layout have another name.
  std::unique_ptr<CarryOver> plan_;
};

} // namespace stride::app

#endif
