#include "drivers/can/plan/drive_settings.hpp"

#include "runtime/common/setup_text.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <optional>

namespace stride::can {
namespace {

using common::linesOf;
using common::trimmed;
using common::wholeNumber;

/// Types of start-up parameters, by their names in IEC 61131-3.
struct TypeRow {
  std::string_view name;
  ObjectForm form;
};
constexpr std::array<TypeRow, 13> kTypes = {{{"BOOL", {1, false}},
                                             {"BYTE", {1, false}},
                                             {"SINT", {1, true}},
                                             {"USINT", {1, false}},
                                             {"INT", {2, true}},
                                             {"UINT", {2, false}},
                                             {"WORD", {2, false}},
                                             {"DINT", {4, true}},
                                             {"UDINT", {4, false}},
                                             {"DWORD", {4, false}},
                                             {"LINT", {8, true}},
                                             {"ULINT", {8, false}},
                                             {"LWORD", {8, false}}}};
constexpr std::string_view kReal = "REAL";
constexpr std::string_view kLreal = "LREAL";
constexpr size_t kLongestText = 255; ///< [bytes]

/// Objects that the driver writes itself, and what of stride.toml decides about them.
struct OwnedRow {
  uint16_t first;
  uint16_t last;
  std::string_view by;
};
constexpr std::array<OwnedRow, 9> kOwned = {{
    {0x1005, 0x1006, "`SyncProducer` and the cycle"},
    {0x100C, 0x100D, "`guard`"},
    {0x1016, 0x1017, "`heartbeat`"},
    {0x1020, 0x1020, "the driver: what is configured has its stamp there"},
    {0x1400, 0x17FF, "the tables `rpdo1` … `rpdo4`"},
    {0x1800, 0x1BFF, "the tables `tpdo1` … `tpdo4`"},
    {0x6040, 0x6041, "the driver: it is the drive's state machine"},
    {0x6060, 0x6061, "the controller mode"},
    {0x60C2, 0x60C2, "the cycle"},
}};

bool fail(std::string &error, std::string text) {
  error = std::move(text);
  return false;
}

/// "6098h".
std::optional<uint16_t> indexIn(std::string_view text) {
  constexpr size_t kDigits = 4;
  if (text.size() != kDigits + 1 || (text.back() != 'h' && text.back() != 'H'))
    return std::nullopt;
  const auto value = wholeNumber(text.substr(0, kDigits), 16);
  return value ? std::optional(static_cast<uint16_t>(*value)) : std::nullopt;
}

/// Up to three parts between colons: index, subindex, and bits where `bits` is not null.
bool objectOf(std::string_view text, Object &object, std::optional<uint64_t> *bits,
              std::string &error) {
  std::array<std::string_view, 3> parts;
  size_t count = 0;
  for (size_t at = 0; at <= text.size(); ++count) {
    const size_t end = std::min(text.find(':', at), text.size());
    if (count == (bits != nullptr ? 3U : 2U))
      return fail(error, "too many colons");
    parts[count] = trimmed(text.substr(at, end - at));
    at = end + 1;
  }
  const auto index = indexIn(parts[0]);
  if (!index)
    return fail(error, "an object is written as 6098h, or with its subindex as 6099h:1");
  const auto sub = count > 1 ? wholeNumber(parts[1], 10) : std::optional<uint64_t>(0);
  if (!sub || *sub > UINT8_MAX)
    return fail(error, "a subindex is a number from 0 to 255");
  object = {*index, static_cast<uint8_t>(*sub)};
  if (count < 3)
    return true;
  *bits = wholeNumber(parts[2], 10);
  return *bits ? true : fail(error, "the bits of an object are a number");
}

std::optional<uint64_t> fitted(const common::WholeNumber &number, const ObjectForm &form,
                               bool isBool) {
  const unsigned bits = 8U * form.bytes;
  const uint64_t all = UINT64_MAX >> (64 - bits);
  const uint64_t most = isBool ? 1 : form.isSigned ? all >> 1U : all;
  const uint64_t least = form.isSigned ? most + 1 : 0; // below zero
  if (number.magnitude > (number.negative ? least : most))
    return std::nullopt;
  const uint64_t word = number.negative ? ~number.magnitude + 1 : number.magnitude;
  return word & all;
}

void set(SdoWrite &write, uint64_t value, uint8_t size) {
  if (size <= sizeof write.value) {
    write.size = size;
    write.value = static_cast<uint32_t>(value);
    return;
  }
  for (unsigned i = 0; i < size; ++i)
    write.bytes.push_back(static_cast<uint8_t>(value >> 8U * i));
}

/// A REAL or a LREAL.
template <class Real, class Bits>
bool realValue(std::string_view text, std::string_view type, SdoWrite &write, std::string &error) {
  Real value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || problem != std::errc() || end != text.data() + text.size() ||
      !std::isfinite(value))
    return fail(error, "this is no " + std::string(type));
  set(write, std::bit_cast<Bits>(value), sizeof value);
  return true;
}

/// "'Axis 1'", without the NUL that ends it in a program.
bool textValue(std::string_view text, SdoWrite &write, std::string &error) {
  constexpr char kQuote = '\'';
  if (text.size() < 3 || text.back() != kQuote)
    return fail(error, "a text is written between quotes, and has one character at least");
  text = text.substr(1, text.size() - 2);
  const bool plain = std::all_of(text.begin(), text.end(), [](char one) {
    return one >= ' ' && one <= '~' && one != kQuote && one != '$';
  });
  if (!plain || text.size() > kLongestText)
    return fail(error, "a text has up to 255 characters of ASCII, without ' and $");
  write.bytes.assign(text.begin(), text.end());
  return true;
}

const TypeRow *typeOf(std::string_view name) {
  const auto *const found = std::find_if(kTypes.begin(), kTypes.end(), [name](const TypeRow &row) {
    return std::equal(
        row.name.begin(), row.name.end(), name.begin(), name.end(),
        [](char a, char b) { return a == (b >= 'a' && b <= 'z' ? b - 'a' + 'A' : b); });
  });
  return found != kTypes.end() ? found : nullptr;
}

/// "35", "SINT#35", "WORD#16#1F".
bool valueOf(std::string_view text, SdoWrite &write, std::string &error, uint8_t axis) {
  const ObjectForm known = formOf(inProfile(write.object, axis));
  ObjectForm form = known;
  const size_t mark = text.find('#');
  const std::string_view name = text.substr(0, mark == std::string_view::npos ? 0 : mark);
  const TypeRow *type = name.empty() ? nullptr : typeOf(name);
  const bool typed = !name.empty() && (name[0] < '0' || name[0] > '9');
  if (text.starts_with('\'') && known.bytes == 0)
    return textValue(text, write, error);
  if (name == kReal && known.bytes == 0)
    return realValue<float, uint32_t>(text.substr(mark + 1), kReal, write, error);
  if (name == kLreal && known.bytes == 0)
    return realValue<double, uint64_t>(text.substr(mark + 1), kLreal, write, error);
  if (typed && type == nullptr)
    return fail(error, "a value has the type BOOL, BYTE, SINT, USINT, INT, UINT, WORD, DINT, "
                       "UDINT, DWORD, LINT, ULINT, LWORD, REAL or LREAL, as in UINT#500, or is a "
                       "text between quotes");
  if (type != nullptr) {
    form = type->form;
    text.remove_prefix(mark + 1);
  }
  if (form.bytes == 0)
    return fail(error, "the type of this object is not known here: write it before the value, as "
                       "in UINT#500");
  if (known.bytes != 0 && known.bytes != form.bytes)
    return fail(error, "this object has " + std::to_string(8 * known.bytes) + " bits");
  const auto number = wholeNumber(text);
  if (!number)
    return fail(error, "this is no whole number");
  const auto value = fitted(*number, form, type != nullptr && type->name == "BOOL");
  if (!value)
    return fail(error, "the value does not fit into " + std::to_string(8 * form.bytes) + " bits" +
                           (form.isSigned ? " with a sign" : " without a sign"));
  set(write, *value, form.bytes);
  return true;
}

/// What is wrong with a PDO as a whole; empty: nothing.
std::string lengthFault(const Pdo &pdo) {
  if (pdo.bits() > Pdo::kMostBits)
    return "it has " + std::to_string(pdo.bits()) + " bits, and 64 is what a PDO has room for";
  return {};
}

class PdoReader {
public:
  PdoReader(uint8_t node, uint8_t axis, const common::SetupParameters &given,
            std::vector<std::string> &errors)
      : given_(given), errors_(errors), node_(node), axis_(axis) {}

  std::vector<Pdo> read(bool transmits) {
    std::vector<Pdo> pdos;
    for (uint8_t number = 1; number <= DrivePlan::kMostPdos; ++number) {
      const std::string table = (transmits ? "tpdo" : "rpdo") + std::to_string(number);
      if (!given_.given(table + ".map"))
        continue;
      Pdo &pdo = pdos.emplace_back();
      pdo.number = static_cast<uint16_t>(kAxisPdos * axis_ + number);
      pdo.cobId = predefinedId(transmits ? kTpdoBase : kRpdoBase, number - 1U, node_, axis_);
      readTiming(table, pdo, transmits);
      readMap(table, pdo, transmits);
    }
    return pdos;
  }

private:
  void readTiming(const std::string &table, Pdo &pdo, bool transmits) {
    if (given_.number(table + ".when") == 0)
      return;
    pdo.transmission = Pdo::kByEvent;
    if (!transmits)
      return;
    pdo.inhibit = scaled(given_.number(table + ".inhibit"), 1e4); // [100 µs]
    pdo.eventTimer = scaled(given_.number(table + ".event"), 1e3);
  }
  static uint16_t scaled(double seconds, double perSecond) {
    return static_cast<uint16_t>(std::clamp(seconds * perSecond + 0.5, 0.0, 65535.0));
  }

  void readMap(const std::string &table, Pdo &pdo, bool transmits) {
    for (const std::string &line : linesOf(given_.text(table + ".map"))) {
      PdoEntry entry;
      std::string error;
      if (!parseEntry(line, entry, error, axis_))
        errors_.push_back("`" + line + "` in `" + table + "`: " + error);
      else if (!transmits && isTold(entry.object))
        errors_.push_back("`" + line + "` in `" + table + "`: the drive tells it and is not told");
      else if (pdo.count == Pdo::kMostEntries)
        errors_.push_back("`" + table + "` has more than 8 objects");
      else
        pdo.entries[pdo.count++] = entry;
    }
    if (const std::string fault = lengthFault(pdo); !fault.empty())
      errors_.push_back("`" + table + "`: " + fault);
  }
  static bool isTold(Object object) {
    const Signal signal = signalOf(object);
    return signal >= Signal::Statusword && signal != Signal::Other;
  }

  const common::SetupParameters &given_;
  std::vector<std::string> &errors_;
  uint8_t node_;
  uint8_t axis_;
};

std::string hexadecimal(uint16_t index) {
  std::string text;
  for (unsigned shift = 16; shift > 0; shift -= 4)
    text += "0123456789ABCDEF"[index >> (shift - 4) & 0xFU];
  return text + "h";
}

} // namespace

std::string foreignAxis(Object object, uint8_t axis) {
  const uint8_t other = axisOf(object);
  if (axis == 0 || other == axis || other == kMostAxes)
    return {};
  return "this object is of axis " + std::to_string(other) + ": of axis " + std::to_string(axis) +
         " it is " + hexadecimal(ofAxis(inProfile(object, other), axis).index);
}

std::string_view ownerOf(Object object, uint8_t axis) {
  object = inProfile(object, axis);
  for (const OwnedRow &row : kOwned)
    if (object.index >= row.first && object.index <= row.last)
      return row.by;
  return {};
}

bool parseStartUp(std::string_view text, SdoWrite &write, std::string &error, uint8_t axis) {
  const size_t sign = text.find(":=");
  if (sign == std::string_view::npos)
    return fail(error, "an entry is an object and its value: \"6098h := 35\"");
  write = {};
  if (!objectOf(trimmed(text.substr(0, sign)), write.object, nullptr, error))
    return false;
  if (const std::string_view owner = ownerOf(write.object, axis); !owner.empty())
    return fail(error, "what is written there is the matter of " + std::string(owner));
  if (std::string foreign = foreignAxis(write.object, axis); !foreign.empty())
    return fail(error, std::move(foreign));
  return valueOf(trimmed(text.substr(sign + 2)), write, error, axis);
}

bool parseEntry(std::string_view text, PdoEntry &entry, std::string &error, uint8_t axis) {
  std::optional<uint64_t> bits;
  if (!objectOf(trimmed(text), entry.object, &bits, error))
    return false;
  if (std::string foreign = foreignAxis(entry.object, axis); !foreign.empty())
    return fail(error, std::move(foreign));
  entry.object = inProfile(entry.object, axis);
  const uint32_t known = 8U * formOf(entry.object).bytes;
  if (!bits && known == 0)
    return fail(error, "the length of this object is not known here: write its bits, as in "
                       "2031h:2:16");
  if (bits && known != 0 && *bits != known)
    return fail(error, "this object has " + std::to_string(known) + " bits");
  if (bits && (*bits == 0 || *bits > Pdo::kMostBits || *bits % 8 != 0))
    return fail(error, "an object in a PDO has whole bytes, 8 to 64 bits");
  entry.bits = static_cast<uint8_t>(bits ? *bits : known);
  return true;
}

DriveSettings driveSettings(uint8_t node, const common::SetupParameters &given, uint8_t axis) {
  DriveSettings settings;
  for (const std::string &line : linesOf(given.text("startup"))) {
    SdoWrite write;
    std::string error;
    if (parseStartUp(line, write, error, axis))
      settings.startup.push_back(write);
    else
      settings.errors.push_back("`" + line + "` in `startup`: " + error);
  }
  PdoReader reader(node, axis, given, settings.errors);
  settings.rpdos = reader.read(false);
  settings.tpdos = reader.read(true);
  return settings;
}

} // namespace stride::can
