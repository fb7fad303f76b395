// What a driver has to say of a drive group before there is one: data for the compiler.
#ifndef STRIDE_RUNTIME_BUS_GROUP_CHECK_HPP
#define STRIDE_RUNTIME_BUS_GROUP_CHECK_HPP

#include <cstddef>
#include <string>
#include <vector>

namespace stride::bus {

/// Something that the driver cannot do, or not well.
struct GroupFinding {
  /// `drive`: of the group as a whole.
  static constexpr size_t kGroup = static_cast<size_t>(-1);

  bool isError = false; ///< FALSE: a warning.
  size_t drive = kGroup;
  std::string message; ///< What is wrong, in a sentence without a full stop.
  std::string label;   ///< Beside the section.
  std::string help;    ///< The way out; empty: there is none.
  size_t io = kGroup;  ///< Not kGroup: it is about this I/O device of the group.
};

using GroupFindings = std::vector<GroupFinding>;

/// What a group exchanges with its drives, for people and for other tools.
struct GroupPlanText {
  /// Of a drive, in a format of the bus: on CAN a concise DCF.
  struct File {
    std::string name;
    std::string bytes;
  };

  std::string text; ///< Lines.
  std::vector<File> files;
};

} // namespace stride::bus

#endif
