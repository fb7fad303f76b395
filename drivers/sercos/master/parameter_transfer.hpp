// Questions of programs for IDNs of a drive: with a minus sign before, the numbers of
// MC_ReadParameter and MC_WriteParameter.
#ifndef STRIDE_DRIVERS_SERCOS_MASTER_PARAMETER_TRANSFER_HPP
#define STRIDE_DRIVERS_SERCOS_MASTER_PARAMETER_TRANSFER_HPP

#include "drivers/sercos/master/service_channel.hpp"
#include "drivers/sercos/plan/cyclic_plan.hpp"
#include "runtime/bus/axis_driver.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace stride::sercos {

/// What a number stands for: bits 0 to 15 the IDN, bits 16 to 18 the element (0: the operation
/// data), bits 19 to 30 which piece of a list or a text: 0 it is none, 1 its length in bytes, from
/// 2 on four bytes each. Reading the length reads the list; writing the length writes what its
/// pieces have been before.
struct ParameterPlace {
  Idn idn = 0;
  Element element = Element::Data;
  size_t piece = 0;
};
std::optional<ParameterPlace> placeOfParameter(int32_t number);

/// One question at a time.
class ParameterTransfer {
public:
  /// `told`: what the drive is told in each cycle.
  explicit ParameterTransfer(const CyclicRecord &told) : told_(told) {}

  /// Most bytes of a list in pieces of four: their places have 12 bits.
  static constexpr size_t kMostInPieces = 4 * 4094;

  void start(const bus::ParameterRequest &request);
  /// Answers at once, with what travels in each cycle.
  void answerWith(int64_t value);
  /// TRUE once the answer is there.
  bool poll(bus::ParameterAnswer &answer);
  /// The question is given up; `channel`: of the drive.
  void cancel(ServiceChannel &channel);
  /// The drive starts anew: what was asked stays without an answer.
  void clear();

  /// It waits for the drive's service channel.
  [[nodiscard]] bool wants() const { return step_ == Step::Asked; }
  /// The channel is free: a transfer begins.
  void begin(ServiceChannel &channel);
  /// The transfer is over.
  void finished(ServiceChannel &channel);
  [[nodiscard]] const bus::ParameterRequest &request() const { return request_; }

private:
  enum class Step : uint8_t {
    Idle,
    Asked,
    Reading,
    Measuring, ///< Write: what the IDN's attribute is.
    Writing,
    List,    ///< Describe: S-0-0192, what there is to be stored, or …
    AllIdns, ///< … S-0-0017 of a drive without it.
    Attribute,
    Name,
    Unit,
    Answered,
  };
  static constexpr size_t kMostListed = 512;

  /// A list, in pieces.
  struct Pieces {
    std::vector<uint8_t> bytes = std::vector<uint8_t>(kMostInPieces);
    size_t size = 0;
    Idn idn = 0;
    Element element = Element::None; ///< None: nothing is in it.

    /// Without memory of its own: for the cyclic path.
    void clear() {
      std::fill(bytes.begin(), bytes.end(), uint8_t{0});
      size = 0;
      idn = 0;
      element = Element::None;
    }
    [[nodiscard]] bool isOf(const ParameterPlace &place) const {
      return element == place.element && idn == place.idn;
    }
  };

  void answer(bus::ParameterAnswer::Result result);
  void startPiece();
  void answerPiece();
  void refused(const ServiceChannel &channel);
  void read(const ServiceChannel &channel);
  void write(ServiceChannel &channel);
  [[nodiscard]] bool encode(const Attribute &attribute, std::span<const uint8_t> &bytes);
  [[nodiscard]] bool encodeNumber(const Attribute &attribute);
  void beginDescribe(ServiceChannel &channel);
  void listRead(ServiceChannel &channel);
  void nextListed(ServiceChannel &channel);
  void described(ServiceChannel &channel);
  [[nodiscard]] bool isTold(Idn idn, const Attribute &attribute) const;

  CyclicRecord told_;
  std::array<uint8_t, 8> number_{}; ///< That is written.
  Pieces read_;
  Pieces write_;
  std::array<Idn, kMostListed> listed_{};
  size_t listCount_ = 0;
  size_t listPlace_ = 0; ///< In listed_, of the one that is being described.
  int32_t next_ = 0;     ///< Which of those that are numbers comes next.
  std::array<char, 40> name_{};
  std::array<char, 15> unit_{};
  bus::ParameterRequest request_;
  bus::ParameterAnswer answer_;
  ParameterPlace place_;
  Step step_ = Step::Idle;
};

} // namespace stride::sercos

#endif
