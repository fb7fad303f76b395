#include "compiler/assets/eds/device.hpp"
#include "compiler/assets/eds/ini.hpp"
#include "compiler/assets/eds/values.hpp"
#include "compiler/assets/eds/xml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace stc::eds {
namespace {

/// What an object's parameter says, where the object refers to it.
struct Parameter {
  std::string access;
  std::string byDefault;
  std::string actual;
  uint16_t type = 0;
};

struct TypeName {
  std::string_view xml;
  uint16_t type;
};

constexpr TypeName kTypeNames[] = {
    {"BOOL", 0x01},  {"SINT", 0x02},     {"INT", 0x03},  {"DINT", 0x04},   {"USINT", 0x05},
    {"UINT", 0x06},  {"UDINT", 0x07},    {"REAL", 0x08}, {"STRING", 0x09}, {"LREAL", 0x11},
    {"LINT", 0x15},  {"ULINT", 0x1B},    {"BYTE", 0x05}, {"WORD", 0x06},   {"DWORD", 0x07},
    {"LWORD", 0x1B}, {"BITSTRING", 0x0A}};

constexpr std::pair<std::string_view, std::string_view> kAccesses[] = {
    {"read", "ro"},     {"write", "wo"},           {"readWrite", "rw"},
    {"const", "const"}, {"readWriteInput", "rwr"}, {"readWriteOutput", "rww"},
    {"noAccess", "ro"}};

std::optional<uint32_t> hex(std::string_view text) {
  if (text.starts_with("0x"))
    text.remove_prefix(2);
  uint32_t value = 0;
  const char *const end = text.data() + text.size();
  const auto [at, error] = std::from_chars(text.data(), end, value, 16);
  if (text.empty() || error != std::errc() || at != end)
    return std::nullopt;
  return value;
}

class XddReader {
public:
  explicit XddReader(std::string_view text) : text_(text) {}

  Device read() {
    readParameters();
    XmlTags tags(text_);
    XmlTag tag;
    while (tags.next(tag)) {
      if (!tag.opens)
        continue;
      if (tag.name == "CANopenObject")
        readObject(tag);
      else if (tag.name == "CANopenSubObject")
        addObject(tag, index_, hex(tag["subIndex"]));
      else
        readHead(tag, tags);
    }
    if (tags.problem() != nullptr)
      device_.note(tags.problemLine(), fmt::format("the XML ends here: {}", tags.problem()));
    finish();
    return std::move(device_);
  }

private:
  /// Parameters may come after the objects that refer to them.
  void readParameters() {
    XmlTags tags(text_);
    XmlTag tag;
    Parameter *current = nullptr;
    while (tags.next(tag)) {
      if (tag.name == "parameter") {
        current = tag.opens && !tag.closes ? &parameters_[std::string(tag["uniqueID"])] : nullptr;
        if (current != nullptr)
          current->access = tag["access"];
        continue;
      }
      if (current == nullptr || !tag.opens)
        continue;
      if (tag.name == "defaultValue")
        current->byDefault = tag["value"];
      else if (tag.name == "actualValue")
        current->actual = tag["value"];
      for (const TypeName &type : kTypeNames)
        if (tag.name == type.xml && current->type == 0)
          current->type = type.type;
    }
  }

  void readHead(const XmlTag &tag, const XmlTags &tags) {
    Identity &identity = device_.identity;
    if (tag.name == "vendorName")
      identity.vendorName = tags.text();
    else if (tag.name == "productName")
      identity.productName = tags.text();
    else if (tag.name == "orderNumber")
      identity.orderCode = tags.text();
    else if (tag.name == "vendorID")
      identity.vendor = static_cast<uint32_t>(numberOf(tags.text()).value_or(0));
    else if (tag.name == "productID")
      identity.product = static_cast<uint32_t>(numberOf(tags.text()).value_or(0));
    else if (tag.name == "CANopenGeneralFeatures")
      readFeatures(tag);
    else if (tag.name == "supportedBaudRate")
      readBitRate(tag["value"]);
    else if (tag.name == "deviceCommissioning")
      readCommissioning(tag);
  }

  void readFeatures(const XmlTag &tag) {
    if (const auto count = numberOf(tag["nrOfRxPDO"]); count && *count >= 0 && *count <= 512)
      device_.receivePdos = static_cast<uint16_t>(*count);
    if (const auto count = numberOf(tag["nrOfTxPDO"]); count && *count >= 0 && *count <= 512)
      device_.transmitPdos = static_cast<uint16_t>(*count);
    device_.settable = flagOf(tag["layerSettingServiceSlave"]).value_or(false);
  }

  /// "500 Kbps".
  void readBitRate(std::string_view text) {
    for (size_t i = 0; i < std::size(kBitRates); ++i)
      if (text.substr(0, text.find(' ')) == std::to_string(kBitRates[i]))
        device_.bitRates |= 1U << i;
  }

  void readCommissioning(const XmlTag &tag) {
    if (const auto id = numberOf(tag["nodeID"]); id && *id >= 1 && *id <= 127)
      device_.nodeId = static_cast<uint8_t>(*id);
    const std::string_view rate = tag["actualBaudRate"];
    if (const auto number = numberOf(rate.substr(0, rate.find(' ')));
        number && *number > 0 && *number <= 1000)
      device_.bitRate = static_cast<uint32_t>(*number);
  }

  void readObject(const XmlTag &tag) {
    const std::optional<uint32_t> index = hex(tag["index"]);
    if (!index || *index > 0xFFFF) {
      device_.note(tag.line, fmt::format("\"{}\" is no index of an object", tag["index"]));
      index_ = std::nullopt;
      return;
    }
    index_ = static_cast<uint16_t>(*index);
    const std::optional<int64_t> kind = numberOf(tag["objectType"]);
    if (kind && (*kind == 2 || *kind == 7))
      addObject(tag, index_, 0);
  }

  void addObject(const XmlTag &tag, std::optional<uint16_t> index, std::optional<uint32_t> sub) {
    if (!index || !sub || *sub > 0xFF) {
      device_.note(tag.line, fmt::format("\"{}\" is no subindex", tag["subIndex"]));
      return;
    }
    if (device_.objects.size() >= Device::kMostObjects)
      return;
    Object object;
    object.index = *index;
    object.sub = static_cast<uint8_t>(*sub);
    object.line = tag.line;
    object.name = inUtf8(tag["name"]);
    const auto found = parameters_.find(tag["uniqueIDRef"]);
    const Parameter parameter = found == parameters_.end() ? Parameter{} : found->second;
    object.type = static_cast<uint16_t>(hex(tag["dataType"]).value_or(parameter.type));
    if (typeName(object.type).empty())
      device_.note(tag.line, fmt::format("{} has no data type that is known", nameOf(object)));
    readAccess(tag, parameter, object);
    const std::optional<bool> mappable = flagOf(tag["PDOmapping"]);
    object.mappable = mappable.value_or(false);
    const auto value = [&](std::string_view own, std::string_view other, std::string_view what) {
      return readValue(own.empty() ? other : own, tag.line, object, what, device_);
    };
    object.byDefault = value(tag["defaultValue"], parameter.byDefault, "defaultValue");
    object.configured = value(tag["actualValue"], parameter.actual, "actualValue");
    object.low = value(tag["lowLimit"], {}, "lowLimit");
    object.high = value(tag["highLimit"], {}, "highLimit");
    checkLimits(object, device_);
    device_.objects.push_back(std::move(object));
  }

  void readAccess(const XmlTag &tag, const Parameter &parameter, Object &object) {
    std::string_view text = tag["accessType"];
    for (const auto &[name, access] : kAccesses)
      if (text.empty() && parameter.access == name)
        text = access;
    if (text.empty())
      return;
    if (const std::optional<Access> access = accessOf(text))
      object.access = *access;
    else
      device_.note(tag.line,
                   fmt::format("accessType of {}: \"{}\" is taken for rw", nameOf(object), text));
  }

  void finish() {
    std::stable_sort(device_.objects.begin(), device_.objects.end(),
                     [](const Object &a, const Object &b) {
                       return a.index != b.index ? a.index < b.index : a.sub < b.sub;
                     });
    const auto same = [](const Object &a, const Object &b) {
      return a.index == b.index && a.sub == b.sub;
    };
    const auto end = std::unique(device_.objects.begin(), device_.objects.end(), same);
    if (end != device_.objects.end())
      device_.note(0, "some objects stand twice: the first ones count");
    device_.objects.erase(end, device_.objects.end());
    if (device_.objects.empty())
      device_.note(0, "the file has no CANopenObject: is it an XDD?");
    if (device_.identity.vendor == 0)
      device_.note(0, "no vendorID: any device is taken for it");
  }

  std::string_view text_;
  Device device_;
  std::map<std::string, Parameter, std::less<>> parameters_;
  std::optional<uint16_t> index_;
};

} // namespace

Device readXdd(std::string_view text) { return XddReader(text).read(); }

} // namespace stc::eds
