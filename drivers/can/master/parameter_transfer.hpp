// Questions of programs for objects of a drive, whose numbers are index * 256 + subindex: with a
// minus sign before, those of MC_ReadParameter and MC_WriteParameter.
#ifndef STRIDE_DRIVERS_CAN_MASTER_PARAMETER_TRANSFER_HPP
#define STRIDE_DRIVERS_CAN_MASTER_PARAMETER_TRANSFER_HPP

#include "drivers/can/master/sdo_client.hpp"
#include "drivers/can/plan/pdo_plan.hpp"
#include "runtime/bus/axis_driver.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stride::can {

/// The object of a parameter's number, if it can be one.
std::optional<Object> objectOfParameter(int32_t number);
/// The number of an object.
int32_t parameterOf(Object object);

/// One question at a time.
class ParameterTransfer {
public:
  /// What programs find by asking for a list: these objects, and then those that drives usually
  /// have for their configuration, as far as the node has them. `axis`: of the device that it is.
  explicit ParameterTransfer(std::span<const SdoWrite> listed, uint8_t axis = 0);

  void start(const bus::ParameterRequest &request);
  /// TRUE once the answer is there.
  bool poll(bus::ParameterAnswer &answer);
  /// The question is given up; `sdo`: of the node.
  void cancel(SdoClient &sdo);
  /// The same, while the node's SDO channel works for somebody else.
  void forget() { step_ = Step::Idle; }
  /// The node starts anew: what was asked stays without an answer.
  void clear();

  /// It waits for the node's SDO channel.
  [[nodiscard]] bool wants() const { return step_ == Step::Asked; }
  /// The channel is free: a transfer begins.
  void begin(SdoClient &sdo);
  /// The transfer is over.
  void finished(SdoClient &sdo);

private:
  enum class Step : uint8_t {
    Idle,
    Asked,
    Reading,
    Measuring, ///< Write: how long the object is.
    Writing,
    Probing, ///< Describe: whether there is such an object.
    Answered,
  };
  /// Whether the node has an object of the list.
  enum class There : uint8_t { Unknown, Yes, No };
  struct Listed {
    Object object;
    std::string name;
    There there = There::Unknown;
  };

  void list(Object object, There there);
  void describe();
  void probed(bool there);
  void answer(bus::ParameterAnswer::Result result);
  void read(size_t size);
  void write(SdoClient &sdo, size_t size);
  void aborted(const SdoClient &sdo);
  [[nodiscard]] bool encode(size_t size);

  std::vector<Listed> listed_;
  std::array<uint8_t, bus::ByteString::kMost> bytes_{};
  bus::ParameterRequest request_;
  bus::ParameterAnswer answer_;
  Object object_;
  uint8_t axis_;
  size_t probe_ = 0; ///< The place in the list that is looked for.
  Step step_ = Step::Idle;
};

} // namespace stride::can

#endif
