// The object dictionary of a simulated node: a table of objects with type, access and value.
// [CiA 301, object dictionary]
#ifndef STRIDE_DRIVERS_CAN_SIMULATION_DICTIONARY_HPP
#define STRIDE_DRIVERS_CAN_SIMULATION_DICTIONARY_HPP

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace stride::can::simulation {

/// Static data types, by their index in the dictionary.
enum class DataType : uint8_t {
  Boolean = 0x01,
  Integer8 = 0x02,
  Integer16 = 0x03,
  Integer32 = 0x04,
  Unsigned8 = 0x05,
  Unsigned16 = 0x06,
  Unsigned32 = 0x07,
  Real32 = 0x08,
  VisibleString = 0x09,
  OctetString = 0x0A,
  Domain = 0x0F,
  Real64 = 0x11,
  Integer64 = 0x15,
  Unsigned24 = 0x16,
  Unsigned40 = 0x18,
  Unsigned48 = 0x19,
  Unsigned56 = 0x1A,
  Unsigned64 = 0x1B,
};

/// Bytes of a value; 0: as many as there are.
size_t bytesOf(DataType type);
bool isSigned(DataType type);

enum class Access : uint8_t { Const, ReadOnly, WriteOnly, ReadWrite };

/// In which process data an object may be; combined with |.
enum Mapping : uint8_t { kUnmapped = 0, kInTransmit = 1, kInReceive = 2, kInBoth = 3 };

/// One object, or one of several below an index.
struct ObjectRow {
  uint16_t index = 0;
  uint8_t sub = 0;
  DataType type = DataType::Unsigned32;
  Access access = Access::ReadWrite;
  uint8_t mapping = kUnmapped;
  uint64_t value = 0;      ///< When the node is new.
  bool plusId = false;     ///< … and the node's id is added to that.
  int64_t low = 0;         ///< The least and …
  int64_t high = 0;        ///< … the largest value; equal: every value of the type.
  std::string_view text{}; ///< Of a string, when the node is new.
  size_t room = 0;         ///< Most bytes of a string or a domain; at least those of `text`.
};

/// Why a transfer ends. [CiA 301, SDO abort codes]
enum class Abort : uint32_t {
  None = 0,
  Toggle = 0x05030000,
  TimedOut = 0x05040000,
  CommandSpecifier = 0x05040001,
  BlockSize = 0x05040002,
  SequenceNumber = 0x05040003,
  Checksum = 0x05040004,
  Unsupported = 0x06010000,
  WriteOnly = 0x06010001,
  ReadOnly = 0x06010002,
  NoObject = 0x06020000,
  NotMappable = 0x06040041,
  PdoLength = 0x06040042,
  Length = 0x06070010,
  TooLong = 0x06070012,
  TooShort = 0x06070013,
  NoSub = 0x06090011,
  Value = 0x06090030,
  ValueHigh = 0x06090031,
  ValueLow = 0x06090032,
  General = 0x08000000,
  NotStored = 0x08000020,
  LocalControl = 0x08000021,
  State = 0x08000022,
};

/// An object with its value.
struct Entry {
  ObjectRow row;
  uint64_t value = 0;        ///< The bits; signed types are sign-extended.
  std::vector<uint8_t> text; ///< Of strings and domains; never more than row.room bytes.

  [[nodiscard]] bool isText() const { return bytesOf(row.type) == 0; }
  [[nodiscard]] size_t size() const { return isText() ? text.size() : bytesOf(row.type); }
  [[nodiscard]] size_t room() const { return isText() ? row.room : bytesOf(row.type); }
  [[nodiscard]] int64_t asSigned() const { return static_cast<int64_t>(value); }
  [[nodiscard]] bool is(uint16_t index, uint8_t sub) const {
    return row.index == index && row.sub == sub;
  }
};

/// Bytes as they travel, low ones first. As many as there are in `bytes`, which is at most 8.
uint64_t decode(std::span<const uint8_t> bytes);
void encode(uint64_t value, std::span<uint8_t> bytes);

class Dictionary {
public:
  /// In any order; the last one of several for the same object counts.
  explicit Dictionary(std::vector<ObjectRow> rows);

  /// Null: there is none.
  [[nodiscard]] Entry *find(uint16_t index, uint8_t sub);
  [[nodiscard]] const Entry *find(uint16_t index, uint8_t sub) const;

  /// One that must exist: for the device that has made the rows. Throws std::out_of_range.
  [[nodiscard]] Entry &at(uint16_t index, uint8_t sub = 0);

  /// The value of an object, 0 without it.
  [[nodiscard]] uint64_t value(uint16_t index, uint8_t sub = 0) const;

  /// What says a request for an object that is not there.
  [[nodiscard]] Abort missing(uint16_t index) const;

  /// The bits as the type has them: cut and sign-extended.
  static uint64_t fitted(DataType type, uint64_t bits);

  /// Whether the value may be written, by the row alone.
  static Abort checkRange(const Entry &entry, uint64_t value);

  /// Back to the values of the rows, or to those that were stored since, from `first` to `last`, in
  /// a node with that id.
  void restore(uint16_t first, uint16_t last, uint8_t nodeId);
  /// Values of ReadWrite objects are those that restore brings back.
  void store(uint16_t first, uint16_t last);
  /// The next restore brings back the values of the rows.
  void forgetStored();

  [[nodiscard]] std::span<Entry> entries() { return entries_; }
  /// Bytes of the longest value that there can be.
  [[nodiscard]] size_t mostBytes() const;

private:
  std::vector<Entry> entries_; ///< In the order of index and subindex.
  struct Stored {
    uint64_t value = 0;
    bool plusId = false;
  };
  std::vector<Stored> stored_; ///< What restore brings back.
};

} // namespace stride::can::simulation

#endif
