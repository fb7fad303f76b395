#include "compiler/project/io_config.hpp"

#include "compiler/project/driver_sections.hpp"
#include "compiler/source/suggest.hpp"
#include "compiler/syntax/st_text.hpp"
#include "drivers/io/registry.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <optional>

namespace stc {

namespace {

/// `%QX0.3`, `%QW2` in bytes and bits of its area.
struct Channel {
  bool output = false;
  uint32_t byte = 0;
  uint32_t bytes = 1;
  int bit = -1;
};

std::optional<Channel> readAddress(std::string_view text, Addressing addressing) {
  if (text.size() < 3 || text[0] != '%')
    return std::nullopt;
  Channel channel;
  const char area = static_cast<char>(text[1] & ~0x20);
  if (area != 'I' && area != 'Q')
    return std::nullopt;
  channel.output = area == 'Q';
  text.remove_prefix(2);
  char size = 'X';
  if (text[0] > '9') {
    size = static_cast<char>(text[0] & ~0x20);
    text.remove_prefix(1);
  }
  constexpr std::string_view kSizes = "XBWDL";
  const size_t known = kSizes.find(size);
  if (known == std::string_view::npos)
    return std::nullopt;
  channel.bytes = known == 0 ? 1 : 1U << (known - 1);
  uint32_t first = 0;
  const char *end = text.data() + text.size();
  auto [at, error] = std::from_chars(text.data(), end, first);
  if (error != std::errc() || first > 16'777'216)
    return std::nullopt;
  if (size != 'X') {
    channel.byte = addressing == Addressing::Bytes ? first : first * channel.bytes;
    return at == end ? std::optional(channel) : std::nullopt;
  }
  uint32_t bit = first % 8;
  channel.byte = first / 8;
  if (at != end) {
    const unsigned perUnit = addressing == Addressing::Words ? 16 : 8;
    if (*at != '.')
      return std::nullopt;
    const auto [behind, bad] = std::from_chars(at + 1, end, bit);
    if (bad != std::errc() || behind != end || bit >= perUnit)
      return std::nullopt;
    channel.byte = first * (perUnit / 8) + bit / 8;
    bit %= 8;
  }
  channel.bit = static_cast<int>(bit);
  return channel;
}

class DeviceReader {
public:
  DeviceReader(const CheckedSection &section, ProjectConfig &config, Diagnostics &diagnostics)
      : section_(section), config_(config), diagnostics_(diagnostics) {}

  void read() {
    const TomlNode *name = section_.get("name");
    if (name == nullptr || section_.get("device") == nullptr) {
      config_.incomplete = true; // its variable would be missed everywhere
      return;
    }
    IoConfig io;
    io.name = {name->text, name->span};
    for (const IoConfig &other : config_.ioDevices) {
      if (equalIgnoringCase(other.name.text, io.name.text)) {
        diagnostics_
            .report(Code::ConfigDuplicateName, name->span,
                    fmt::format("two I/O devices are named `{}`", name->text), "used again here")
            .label(other.name.span, "first used here");
        return;
      }
    }
    AppConfig::IoDevice &device = io.device;
    device.name = name->text;
    const stride::io::IoSchema &driver =
        *stride::drivers::kIoSchemas[static_cast<size_t>(section_.choice("device"))];
    device.driver = driver.name;
    device.inputFirst = number("inputs_at");
    device.inputCount = number("inputs");
    device.outputFirst = number("outputs_at");
    device.outputCount = number("outputs");
    device.safeOutputs.resize(device.outputCount);
    if (section_.choice("on_loss") == 1)
      device.safeInputs.resize(device.inputCount);
    device.holdsInStop = section_.choice("on_stop") == 1;
    readParameters(driver, device);
    readDriverTables(section_, {.counts = {}, .what = "I/O device"}, device.parameters,
                     diagnostics_);
    if (!driver.bus.empty() && !readAxisGroup(driver, io))
      return;
    io.inputSpan = spanOf("inputs", name->span);
    io.outputSpan = spanOf("outputs", name->span);
    checkOverlap(io);
    for (const CheckedSection &channel : section_.sections("channel", diagnostics_))
      readChannel(channel, io);
    config_.ioDevices.push_back(std::move(io));
  }

private:
  uint32_t number(std::string_view key) const {
    return static_cast<uint32_t>(section_.integer(key));
  }
  Span spanOf(std::string_view key, Span otherwise) const {
    const TomlNode *node = section_.get(key);
    return node != nullptr ? node->keySpan.to(node->span) : otherwise;
  }

  /// The axis group that it is at: there is one of that name, with that driver.
  bool readAxisGroup(const stride::io::IoSchema &driver, IoConfig &io) {
    const TomlNode *name = section_.get("axis_group");
    if (name == nullptr)
      return false; // which has been reported
    io.axisGroup = {name->text, name->span};
    std::vector<std::string_view> known;
    for (const AxisGroupConfig &group : config_.axisGroups) {
      if (group.driver != driver.bus)
        continue;
      if (equalIgnoringCase(group.name.text, name->text)) {
        warnAboutDrives(group, io);
        return true;
      }
      known.push_back(group.name.text);
    }
    if (config_.incomplete)
      return false; // it may be one that could not be read
    Diagnostic &d = diagnostics_.report(
        Code::ConfigUnknownChoice, name->span,
        fmt::format("there is no axis group `{}` with the driver {}", name->text, driver.bus),
        "the bus of this device");
    if (const std::string_view near = nearest(name->text, known); !near.empty())
      d.help(fmt::format("did you mean \"{}\"?", near));
    else
      d.help("a channel with I/O devices only is an axis group without drives");
    return false;
  }

  void warnAboutDrives(const AxisGroupConfig &group, const IoConfig &io) {
    if (group.drives.empty())
      return;
    diagnostics_
        .report(Code::ConfigIoAmongDrives, io.axisGroup.span,
                fmt::format("I/O device `{}` shares a bus with drives", io.name.text),
                fmt::format("the bus of {} drive{}", group.drives.size(),
                            group.drives.size() == 1 ? "" : "s"))
        .note("SoftMotion V2.3 has drives alone on a CAN channel, so that nothing delays them; "
              "here the device's PDOs count in the plan of the bus (`stride can plan`)")
        .help("give it a channel of its own: a `[[bus]]` with an axis group without drives");
  }

  /// Those of the driver with their defaults, so that an online change sees what has changed. Names
  /// that a text contains are known only here.
  void readParameters(const stride::io::IoSchema &driver, AppConfig::IoDevice &device) {
    std::vector<ConfigParameter> all;
    addParameters(section_, {}, all);
    for (const Parameter &row : driver.parameters) {
      const auto given = std::find_if(
          all.begin(), all.end(), [&](const ConfigParameter &one) { return one.name == row.name; });
      if (given != all.end())
        device.parameters.push_back(std::move(*given));
      else if (row.otherwise.any)
        device.parameters.push_back(
            {std::string(row.name),
             fmt::format(fmt::runtime(row.otherwise.text), fmt::arg("project", config_.name),
                         fmt::arg("name", device.name)),
             row.otherwise.number});
    }
  }

  void checkOverlap(const IoConfig &io) {
    const auto check = [&](const IoConfig &other, bool output) {
      const AppConfig::IoDevice &a = io.device;
      const AppConfig::IoDevice &b = other.device;
      const uint32_t first = output ? a.outputFirst : a.inputFirst;
      const uint32_t count = output ? a.outputCount : a.inputCount;
      const uint32_t otherFirst = output ? b.outputFirst : b.inputFirst;
      const uint32_t otherCount = output ? b.outputCount : b.inputCount;
      if (first >= otherFirst + otherCount || otherFirst >= first + count)
        return;
      diagnostics_
          .report(Code::IoOverlap, output ? io.outputSpan : io.inputSpan,
                  fmt::format("`{}` and `{}` have {}put byte {} in common", other.name.text,
                              io.name.text, output ? "out" : "in", std::max(first, otherFirst)),
                  fmt::format("bytes {} to {}", first, first + count - 1))
          .label(output ? other.outputSpan : other.inputSpan,
                 fmt::format("bytes {} to {}", otherFirst, otherFirst + otherCount - 1))
          .help(fmt::format("write `{}_at = {}`", output ? "outputs" : "inputs",
                            otherFirst + otherCount));
    };
    for (const IoConfig &other : config_.ioDevices) {
      check(other, false);
      check(other, true);
    }
  }

  void readChannel(const CheckedSection &channel, IoConfig &io) {
    const TomlNode *address = channel.get("address");
    if (address == nullptr)
      return;
    const std::optional<Channel> at = readAddress(address->text, config_.addressing);
    if (!at) {
      diagnostics_
          .report(Code::IoChannel, address->span,
                  fmt::format("`{}` is no address of an input or output", address->text),
                  "not understood")
          .help("write \"%IX0.3\", \"%QB1\", \"%IW2\" or the like");
      return;
    }
    AppConfig::IoDevice &device = io.device;
    const uint32_t first = at->output ? device.outputFirst : device.inputFirst;
    const uint32_t count = at->output ? device.outputCount : device.inputCount;
    if (at->byte < first || at->byte + at->bytes > first + count) {
      Diagnostic &d = diagnostics_.report(
          Code::IoChannel, address->span,
          fmt::format("`{}` does not belong to device `{}`", address->text, io.name.text),
          fmt::format("byte {} of the {}puts", at->byte, at->output ? "out" : "in"));
      if (count == 0)
        d.note(fmt::format("the device has no {}puts", at->output ? "out" : "in"));
      else
        d.label(at->output ? io.outputSpan : io.inputSpan,
                fmt::format("it has the bytes {} to {}", first, first + count - 1));
      return;
    }
    const TomlNode *safe = channel.get("safe_value");
    if (safe == nullptr)
      return;
    std::vector<uint8_t> &bytes = at->output ? device.safeOutputs : device.safeInputs;
    if (bytes.empty()) {
      diagnostics_.report(Code::ConfigWithoutEffect, safe->keySpan,
                          "`safe_value` of an input has no effect here",
                          "only with on_loss = \"safe\"");
      return;
    }
    const int64_t value = channel.integer("safe_value", 0);
    const uint32_t place = at->byte - first;
    const unsigned bits = at->bit >= 0 ? 1 : at->bytes * 8;
    if (bits < 33 && (value >> bits) != 0 && (value >> (bits - 1)) != -1) {
      diagnostics_.report(Code::IoChannel, safe->span,
                          fmt::format("{} does not fit into `{}`", value, address->text),
                          fmt::format("the channel has {} bit{}", bits, bits == 1 ? "" : "s"));
      return;
    }
    if (at->bit >= 0) {
      const auto mask = static_cast<uint8_t>(1U << at->bit);
      bytes[place] = static_cast<uint8_t>(value != 0 ? bytes[place] | mask : bytes[place] & ~mask);
      return;
    }
    for (uint32_t i = 0; i < at->bytes; ++i)
      bytes[place + i] = static_cast<uint8_t>(static_cast<uint64_t>(value) >> (8 * i));
  }

  const CheckedSection &section_;
  ProjectConfig &config_;
  Diagnostics &diagnostics_;
};

} // namespace

void readIoDevice(const CheckedSection &section, ProjectConfig &config, Diagnostics &diagnostics) {
  DeviceReader(section, config, diagnostics).read();
}

} // namespace stc
