// What a driver is told about its drive group when it is made: the PLC configuration, neutrally.
#ifndef STRIDE_RUNTIME_BUS_GROUP_SETUP_HPP
#define STRIDE_RUNTIME_BUS_GROUP_SETUP_HPP

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace stride::bus {

/// A value of stride.toml.
struct SetupParameter {
  std::string
      name; ///< As in stride.toml; in a table below with its name in front: "physics.model".
  std::string text; ///< Texts and choices by name.
  double number;    ///< Numbers, choices by value, BOOLs as 0 and 1, durations in seconds.
};

/// The values of one section of stride.toml.
class SetupParameters {
public:
  void add(SetupParameter parameter) { list_.push_back(std::move(parameter)); }

  [[nodiscard]] const SetupParameter *find(std::string_view name) const {
    for (const SetupParameter &parameter : list_)
      if (parameter.name == name)
        return &parameter;
    return nullptr;
  }
  [[nodiscard]] double number(std::string_view name, double otherwise) const {
    const SetupParameter *parameter = find(name);
    return parameter != nullptr ? parameter->number : otherwise;
  }

private:
  std::vector<SetupParameter> list_;
};

struct DriveSetup {
  std::string name;
  uint32_t id = 0; ///< wDriveId.
  SetupParameters parameters;
};

struct EncoderSetup {
  std::string name;
  uint32_t id = 0; ///< wEncoderId.
  SetupParameters parameters;
};

struct GroupSetup {
  std::string name;
  std::string bus;
  std::string interfaceType;
  double cycleSeconds = 0; ///< Of the group's task.
  SetupParameters busParameters;
  SetupParameters parameters;
  std::vector<DriveSetup> drives;
  std::vector<EncoderSetup> encoders;
};

} // namespace stride::bus

#endif
