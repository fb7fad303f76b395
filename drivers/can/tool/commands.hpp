// The commands of stride-can. Each returns the exit code: 0 good, 1 bad input or no answer.
#ifndef STRIDE_DRIVERS_CAN_TOOL_COMMANDS_HPP
#define STRIDE_DRIVERS_CAN_TOOL_COMMANDS_HPP

#include <cstdint>
#include <string>
#include <vector>

namespace stride::can::tool {

constexpr int kGood = 0;
constexpr int kBad = 1;

struct ScanOptions {
  std::string interface;
  int first = 1;
  int last = 127;
  int timeoutMs = 20;
};
/// Who is at the bus: 1000h and 1018h of every node that answers, and its errors.
int scan(const ScanOptions &options);

struct SdoOptions {
  std::string interface;
  int node = 0;
  std::string object; ///< "6064h", "1018h:1", "0x1018:1"
  std::string type;   ///< "u8", "i32", "string", "hex"; empty: by what comes, or by the value
  std::string value;
  int timeoutMs = 500;
  bool allowed = false;     ///< --write
  bool inOperation = false; ///< --force
};
int sdoRead(const SdoOptions &options);
int sdoWrite(const SdoOptions &options);

struct LssOptions {
  std::string interface;
  /// Vendor, product, revision, serial number of the node; none: one that has no node id.
  std::vector<uint32_t> identity;
  int node = 0;         ///< Its new node id; 0: it is only looked for.
  bool store = false;   ///< For good.
  bool allowed = false; ///< --write
  int timeoutMs = 20;
};
/// Layer setting services: finds a node and gives it a node id.
int lss(const LssOptions &options);

struct MonitorOptions {
  std::string interface;
  std::string application; ///< Whose plan says what PDOs are; empty: none.
  double seconds = 0;      ///< 0: until Ctrl-C.
  uint64_t count = 0;      ///< Of frames; 0: all.
};
int monitor(const MonitorOptions &options);

struct SimulateOptions {
  std::string application;
  std::string interface; ///< Empty: the application's own.
  std::string group;     ///< Empty: the only one on CAN.
  double seconds = 0;    ///< 0: until Ctrl-C.
};
int simulate(const SimulateOptions &options);

} // namespace stride::can::tool

#endif
