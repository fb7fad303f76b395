#include "compiler/assets/eds/device.hpp"
#include "compiler/assets/eds/ini.hpp"
#include "compiler/assets/eds/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace stc::eds {
namespace {

// Object types that have a value of their own or members.
constexpr int64_t kDomain = 2;
constexpr int64_t kVariable = 7;
constexpr int64_t kArray = 8;
constexpr int64_t kRecord = 9;

constexpr uint16_t kDomainType = 0x0F;

/// Where an object's section is: [6041], [1018sub1].
struct Place {
  uint16_t index = 0;
  std::optional<uint8_t> sub;
};

std::optional<uint32_t> hex(std::string_view text, size_t mostDigits) {
  if (text.empty() || text.size() > mostDigits)
    return std::nullopt;
  uint32_t value = 0;
  for (const char c : text) {
    const bool digit = c >= '0' && c <= '9';
    if (!digit && (c < 'a' || c > 'f'))
      return std::nullopt;
    value = value * 16 + static_cast<uint32_t>(digit ? c - '0' : c - 'a' + 10);
  }
  return value;
}

std::optional<Place> placeOf(std::string_view section) {
  const std::optional<uint32_t> index = hex(section.substr(0, 4), 4);
  if (!index || section.size() < 4)
    return std::nullopt;
  Place place{static_cast<uint16_t>(*index), {}};
  const std::string_view rest = section.substr(4);
  if (rest.empty())
    return place;
  const std::optional<uint32_t> sub =
      rest.starts_with("sub") ? hex(rest.substr(3), 2) : std::nullopt;
  if (!sub)
    return std::nullopt;
  place.sub = static_cast<uint8_t>(*sub);
  return place;
}

class EdsReader {
public:
  explicit EdsReader(std::string_view text) : sections_(readIni(text, device_)) {}

  Device read() {
    for (const IniSection &section : sections_) {
      if (section.name == "deviceinfo")
        readInfo(section);
      else if (section.name == "devicecomissioning" || section.name == "devicecommissioning")
        readCommissioning(section);
      else if (const std::optional<Place> place = placeOf(section.name))
        readObject(section, *place);
    }
    finish();
    return std::move(device_);
  }

private:
  [[nodiscard]] static std::string textOf(const IniSection &section, std::string_view key) {
    const IniValue *value = section.find(key);
    return value == nullptr ? std::string() : value->text;
  }

  /// A whole number from 0 to `most`; nothing without it, or with a note.
  std::optional<int64_t> wholeOf(const IniSection &section, std::string_view key, int64_t most) {
    const IniValue *value = section.find(key);
    if (value == nullptr || value->text.empty())
      return std::nullopt;
    const std::optional<int64_t> number = numberOf(value->text);
    if (number && *number >= 0 && *number <= most)
      return number;
    device_.note(value->line, fmt::format("{}: \"{}\" is no number from 0 to {}: left out", key,
                                          value->text, most));
    return std::nullopt;
  }

  void readInfo(const IniSection &section) {
    constexpr int64_t kDword = 0xFFFFFFFF;
    constexpr int64_t kMostPdos = 512;
    Identity &identity = device_.identity;
    identity.vendorName = textOf(section, "vendorname");
    identity.productName = textOf(section, "productname");
    identity.orderCode = textOf(section, "ordercode");
    identity.vendor = static_cast<uint32_t>(wholeOf(section, "vendornumber", kDword).value_or(0));
    identity.product = static_cast<uint32_t>(wholeOf(section, "productnumber", kDword).value_or(0));
    identity.revision =
        static_cast<uint32_t>(wholeOf(section, "revisionnumber", kDword).value_or(0));
    for (size_t i = 0; i < std::size(kBitRates); ++i)
      if (wholeOf(section, fmt::format("baudrate_{}", kBitRates[i]), 1).value_or(0) != 0)
        device_.bitRates |= 1U << i;
    if (const auto pdos = wholeOf(section, "nrofrxpdo", kMostPdos))
      device_.receivePdos = static_cast<uint16_t>(*pdos);
    if (const auto pdos = wholeOf(section, "nroftxpdo", kMostPdos))
      device_.transmitPdos = static_cast<uint16_t>(*pdos);
    device_.settable = wholeOf(section, "lss_supported", 1).value_or(0) != 0;
    if (identity.vendor == 0)
      device_.note(section.line, "no VendorNumber: any device is taken for it");
  }

  void readCommissioning(const IniSection &section) {
    constexpr int64_t kLastNode = 127;
    if (const auto id = wholeOf(section, "nodeid", kLastNode); id && *id != 0)
      device_.nodeId = static_cast<uint8_t>(*id);
    if (const auto rate = wholeOf(section, "baudrate", 1000))
      device_.bitRate = static_cast<uint32_t>(*rate);
    device_.identity.serial =
        static_cast<uint32_t>(wholeOf(section, "lss_serialnumber", 0xFFFFFFFF).value_or(0));
  }

  void readObject(const IniSection &section, const Place &place) {
    const int64_t kind = wholeOf(section, "objecttype", 0xFF).value_or(kVariable);
    if (!place.sub && (kind == kArray || kind == kRecord)) {
      readMany(section, place.index);
      return;
    }
    if (kind != kVariable && kind != kDomain)
      return; // a definition of a type
    if (device_.objects.size() >= Device::kMostObjects) {
      tooMany_ = true;
      return;
    }
    device_.objects.push_back(objectOf(section, place.index, place.sub.value_or(0), kind));
  }

  /// The head of several objects, which have sections of their own, or are all alike
  /// (CompactSubObj).
  void readMany(const IniSection &section, uint16_t index) {
    constexpr int64_t kMost = 254;
    const auto alike = wholeOf(section, "compactsubobj", kMost).value_or(0);
    if (alike == 0)
      return;
    if (device_.objects.size() >= Device::kMostObjects) {
      tooMany_ = true;
      return;
    }
    const Object one = objectOf(section, index, 1, kVariable);
    Object count = one;
    count.sub = 0;
    count.name = "NrOfObjects";
    count.type = 0x05;
    count.access = Access::ReadOnly;
    count.mappable = false;
    count.configured = count.low = count.high = std::nullopt;
    count.byDefault = Value{.number = alike, .text = std::to_string(alike)};
    device_.objects.push_back(count);
    const IniSection *names = sectionOf(fmt::format("{:04x}name", index));
    const IniSection *values = sectionOf(fmt::format("{:04x}value", index));
    for (int64_t sub = 1; sub <= alike && device_.objects.size() < Device::kMostObjects; ++sub) {
      Object object = one;
      object.sub = static_cast<uint8_t>(sub);
      object.name += std::to_string(sub);
      const std::string key = std::to_string(sub);
      if (const IniValue *name = names == nullptr ? nullptr : names->find(key))
        object.name = name->text;
      if (const IniValue *value = values == nullptr ? nullptr : values->find(key))
        object.configured = readValue(value->text, value->line, object, "Value", device_);
      device_.objects.push_back(std::move(object));
    }
  }

  [[nodiscard]] const IniSection *sectionOf(std::string_view name) const {
    const auto found = std::find_if(sections_.begin(), sections_.end(),
                                    [name](const IniSection &one) { return one.name == name; });
    return found == sections_.end() ? nullptr : &*found;
  }

  Object objectOf(const IniSection &section, uint16_t index, uint8_t sub, int64_t kind) {
    Object object;
    object.index = index;
    object.sub = sub;
    object.line = section.line;
    object.name = textOf(section, "parametername");
    object.type = static_cast<uint16_t>(wholeOf(section, "datatype", 0xFFFF).value_or(0));
    if (object.type == 0 && kind == kDomain)
      object.type = kDomainType;
    if (typeName(object.type).empty())
      device_.note(section.line, fmt::format("{} has no data type that is known", nameOf(object)));
    if (const IniValue *access = section.find("accesstype")) {
      if (const std::optional<Access> known = accessOf(access->text))
        object.access = *known;
      else
        device_.note(access->line, fmt::format("AccessType of {}: \"{}\" is taken for rw",
                                               nameOf(object), access->text));
    }
    if (const IniValue *mapping = section.find("pdomapping")) {
      const std::optional<bool> flag = flagOf(mapping->text);
      object.mappable = flag.value_or(false);
      if (!flag)
        device_.note(mapping->line, fmt::format("PDOMapping of {}: \"{}\" is taken for 0",
                                                nameOf(object), mapping->text));
    }
    const auto value = [&](std::string_view key, std::string_view what) -> std::optional<Value> {
      const IniValue *text = section.find(key);
      if (text == nullptr)
        return std::nullopt;
      return readValue(text->text, text->line, object, what, device_);
    };
    object.byDefault = value("defaultvalue", "DefaultValue");
    object.configured = value("parametervalue", "ParameterValue");
    object.low = value("lowlimit", "LowLimit");
    object.high = value("highlimit", "HighLimit");
    checkLimits(object, device_);
    return object;
  }

  /// What only all of it together says.
  void finish() {
    std::stable_sort(device_.objects.begin(), device_.objects.end(),
                     [](const Object &a, const Object &b) {
                       return a.index != b.index ? a.index < b.index : a.sub < b.sub;
                     });
    const auto same = [](const Object &a, const Object &b) {
      return a.index == b.index && a.sub == b.sub;
    };
    for (size_t i = 1; i < device_.objects.size(); ++i)
      if (same(device_.objects[i - 1], device_.objects[i]))
        device_.note(device_.objects[i].line,
                     nameOf(device_.objects[i]) + " stands twice: the first one counts");
    device_.objects.erase(std::unique(device_.objects.begin(), device_.objects.end(), same),
                          device_.objects.end());
    if (tooMany_)
      device_.note(0, fmt::format("there are more than {} objects: the others are left out",
                                  Device::kMostObjects));
    checkLists();
    checkCounts();
    if (device_.objects.empty())
      device_.note(0, "the file has no object: is it an EDS?");
  }

  /// The lists of objects and the objects are the same ones.
  void checkLists() {
    std::set<uint16_t> listed;
    bool lists = false;
    for (const char *name : {"mandatoryobjects", "optionalobjects", "manufacturerobjects"}) {
      const IniSection *section = sectionOf(name);
      lists = lists || section != nullptr;
      if (section == nullptr)
        continue;
      for (const auto &[key, value] : section->keys) {
        if (key == "supportedobjects")
          continue;
        const std::optional<int64_t> index = numberOf(value.text);
        if (!index || *index < 0 || *index > 0xFFFF)
          device_.note(value.line, fmt::format("[{}]: \"{}\" is no index", name, value.text));
        else if (listed.insert(static_cast<uint16_t>(*index)).second &&
                 sectionOf(fmt::format("{:04x}", *index)) == nullptr)
          device_.note(value.line, fmt::format("{:04X}h is listed, and has no section", *index));
      }
    }
    uint16_t last = 0;
    for (const Object &object : device_.objects) {
      if (lists && object.index != last && !listed.contains(object.index))
        device_.note(object.line, fmt::format("{:04X}h has a section, and is not listed: it counts",
                                              object.index));
      last = object.index;
    }
  }

  /// PDOs that have places, and a count of 0 before them.
  void checkCounts() {
    for (const Pdo &pdo : pdosOf(device_)) {
      const auto index = static_cast<uint16_t>((pdo.transmit ? 0x1A00 : 0x1600) + pdo.number - 1);
      const Object *count = device_.find(index, 0);
      if (!pdo.map.empty() && count != nullptr && count->value() != nullptr &&
          count->value()->number == 0)
        device_.note(count->line,
                     fmt::format("{:04X}h maps 0 objects, and names {}: they are taken for its "
                                 "mapping",
                                 index, pdo.map.size()));
    }
  }

  Device device_;
  std::vector<IniSection> sections_;
  bool tooMany_ = false;
};

} // namespace

const Object *Device::find(uint16_t index, uint8_t sub) const {
  const auto found =
      std::lower_bound(objects.begin(), objects.end(), std::pair(index, sub),
                       [](const Object &object, const std::pair<uint16_t, uint8_t> &wanted) {
                         return object.index != wanted.first ? object.index < wanted.first
                                                             : object.sub < wanted.second;
                       });
  return found != objects.end() && found->index == index && found->sub == sub ? &*found : nullptr;
}

void Device::note(size_t line, std::string text) {
  if (notes.size() < kMostNotes)
    notes.push_back({line, std::move(text)});
  else
    ++moreNotes;
}

Device readEds(std::string_view text) { return EdsReader(text).read(); }

} // namespace stc::eds
