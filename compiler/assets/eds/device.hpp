// What the maker of a CANopen device says about it: an electronic data sheet (EDS), or a
// configuration made of one (DCF), as data. [CiA 306, CiA 311]
#ifndef STRIDE_COMPILER_ASSETS_EDS_DEVICE_HPP
#define STRIDE_COMPILER_ASSETS_EDS_DEVICE_HPP

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stc::eds {

/// How an object may be used. Rwr and Rww: as ReadWrite, and in process data of one direction only.
enum class Access : uint8_t { Const, ReadOnly, WriteOnly, ReadWrite, Rwr, Rww };

/// A number, with the node's identifier added to it if the file says so ("$NODEID+0x180"), or a
/// text.
struct Value {
  int64_t number = 0;
  bool plusNodeId = false;
  bool isText = false; ///< It is no number, because the object is none.
  std::string text;    ///< As in the file, in UTF-8.

  /// The number in a node with that identifier.
  [[nodiscard]] int64_t in(uint8_t nodeId) const { return number + (plusNodeId ? nodeId : 0); }
};

/// An object, or one of several below an index.
struct Object {
  uint16_t index = 0;
  uint8_t sub = 0;
  std::string name;
  uint16_t type = 0; ///< Index of the data type; 0: not known.
  Access access = Access::ReadWrite;
  bool mappable = false;
  std::optional<Value> byDefault;
  std::optional<Value> configured; ///< Of a DCF: what it shall be.
  std::optional<Value> low;
  std::optional<Value> high;
  size_t line = 0;

  [[nodiscard]] bool isReadable() const { return access != Access::WriteOnly; }
  [[nodiscard]] bool isWritable() const {
    return access != Access::Const && access != Access::ReadOnly;
  }
  /// What it is when the start-up begins: configured, else by default; nothing: nobody says.
  [[nodiscard]] const Value *value() const {
    return configured ? &*configured : byDefault ? &*byDefault : nullptr;
  }
};

/// Bits of a value of that type; 0: as many as there are, or not known.
unsigned bitsOf(uint16_t type);
bool isSigned(uint16_t type);
/// Whether values of that type are whole numbers.
bool isWhole(uint16_t type);
/// As people call it: "UNSIGNED32"; empty: not known.
std::string_view typeName(uint16_t type);

/// What 1018h is to be. 0: any, or not said.
struct Identity {
  std::string vendorName;
  std::string productName;
  std::string orderCode;
  uint32_t vendor = 0;
  uint32_t product = 0;
  uint32_t revision = 0;
  uint32_t serial = 0; ///< Of a DCF.
};

/// One PDO of the device, as it is by default or configured.
struct Pdo {
  bool transmit = false;
  uint16_t number = 0; ///< From 1.
  std::optional<Value> cobId;
  std::optional<uint8_t> type;
  std::vector<uint32_t> map; ///< Index, subindex, bits.
  size_t places = 0;         ///< Objects that it has room for.
  bool fixedMapping = false; ///< Nobody may change the mapping.
  bool hasInhibitTime = false;
  bool hasEventTimer = false;
};

/// Something about the file that is not as it should be, and how it was understood.
struct Note {
  size_t line = 0; ///< From 1; 0: about the whole file.
  std::string text;
};

struct Device {
  Identity identity;
  uint32_t bitRates = 0;                ///< Bit n: the n-th of kBitRates is supported.
  std::optional<uint16_t> receivePdos;  ///< As the file says it.
  std::optional<uint16_t> transmitPdos; ///< As the file says it.
  bool settable = false;                ///< Its identifier can be set by LSS.
  std::optional<uint8_t> nodeId;        ///< Of a DCF.
  std::optional<uint32_t> bitRate;      ///< Of a DCF. [kbit/s]
  std::vector<Object> objects;          ///< In the order of index and subindex.
  std::vector<Note> notes;              ///< The first ones, kMostNotes at most.
  size_t moreNotes = 0;

  static constexpr size_t kMostNotes = 200;
  static constexpr size_t kMostObjects = 20000;

  /// Null: there is none.
  [[nodiscard]] const Object *find(uint16_t index, uint8_t sub) const;
  void note(size_t line, std::string text);
};

/// [kbit/s]
inline constexpr uint32_t kBitRates[] = {10, 20, 50, 125, 250, 500, 800, 1000};

/// Reads an EDS or a DCF. Whatever the text is, it is looked at to its end; what is strange becomes
/// a note.
Device readEds(std::string_view text);

/// Reads an XDD or an XDC. [CiA 311]
Device readXdd(std::string_view text);

/// All that have communication parameters.
std::vector<Pdo> pdosOf(const Device &device);

} // namespace stc::eds

#endif
