#include "compiler/semantics/config/registers.hpp"

#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/locations.hpp"
#include "compiler/syntax/attributes.hpp"
#include "runtime/numeric/csy/register_map.hpp"

#include <algorithm>

namespace stc::sema {

using namespace ast;
namespace csy = stride::csy;

namespace {

/// Number of racks' slots in the short form `%MW104.21.10` of older programs.
constexpr uint32_t kSlots = 100;

struct Channel {
  uint32_t module = 0; ///< index into the settings
  uint32_t number = 0; ///< 0 to csy::kModuleChannel
};

/// A channel, and the numbers after it.
struct Named {
  Channel channel;
  std::span<const uint32_t> rest;
};

std::optional<uint32_t> moduleAt(const Context &c, uint32_t rack, uint32_t slot) {
  const auto &modules = c.program.settings.modules;
  for (uint32_t i = 0; i < modules.size(); ++i)
    if (modules[i].rack == rack && modules[i].slot == slot)
      return i;
  return std::nullopt;
}

/// `rack.slot.channel`, or `(100 * rack + slot).channel`.
std::optional<Named> named(const Context &c, const DirectAddress &address) {
  const std::span<const uint32_t> numbers = address.numbers;
  const auto channelOf = [](uint32_t number) {
    // The number that stands for MOD is none of a channel.
    return number == DirectAddress::kModule ? csy::kModuleChannel
           : number == csy::kModuleChannel  ? csy::kModuleChannel + 1
                                            : number;
  };
  if (numbers.size() >= 3)
    if (const auto module = moduleAt(c, numbers[0], numbers[1]))
      return Named{{*module, channelOf(numbers[2])}, numbers.subspan(3)};
  if (numbers.size() >= 2)
    if (const auto module = moduleAt(c, numbers[0] / kSlots, numbers[0] % kSlots))
      return Named{{*module, channelOf(numbers[1])}, numbers.subspan(2)};
  return std::nullopt;
}

csy::RegisterArea areaOf(char letter) {
  return letter == 'I'   ? csy::RegisterArea::Input
         : letter == 'Q' ? csy::RegisterArea::Output
                         : csy::RegisterArea::Memory;
}

csy::RegisterType typeOf(char size) {
  return size == 'F'   ? csy::RegisterType::Real
         : size == 'D' ? csy::RegisterType::Dint
         : size == 'W' ? csy::RegisterType::Int
                       : csy::RegisterType::Bool;
}

const Type *typeOf(csy::RegisterType type) {
  switch (type) {
  case csy::RegisterType::Bool:
    return elementaryType(TypeKind::Boolean);
  case csy::RegisterType::Int:
    return elementaryType(TypeKind::Int);
  case csy::RegisterType::Dint:
    return elementaryType(TypeKind::Dint);
  case csy::RegisterType::Real:
    break;
  }
  return elementaryType(TypeKind::Real);
}

Location locationOf(const Channel &channel, csy::RegisterArea area, csy::ImagePlace place) {
  Location at;
  at.area = area == csy::RegisterArea::Input    ? Area::Input
            : area == csy::RegisterArea::Output ? Area::Output
                                                : Area::Memory;
  at.byte = csy::startOfModule(area, channel.module) + channel.number * csy::bytesOfChannel(area) +
            place.byte;
  at.bit = place.bit;
  return at;
}

/// Makes the areas hold the module, whatever stride.toml says of the program's own bytes.
void reserveModule(Context &c, uint32_t module) {
  constexpr csy::RegisterArea kAreas[] = {csy::RegisterArea::Input, csy::RegisterArea::Output,
                                          csy::RegisterArea::Memory};
  for (size_t i = 0; i < 3; ++i) {
    const uint32_t more = kAreas[i] == csy::RegisterArea::Output ? csy::kStopOutputs : 0;
    const uint32_t end = csy::startOfModule(kAreas[i], module) + more +
                         (csy::kModuleChannel + 1) * csy::bytesOfChannel(kAreas[i]);
    c.program.image.bytes[i] = std::max(c.program.image.bytes[i], end);
  }
}

Diagnostic &refuse(Context &c, const DirectAddress &address, std::string message,
                   std::string label) {
  return c.report(Code::AddressBeyond, address.span, std::move(message), std::move(label));
}

/// The kinds as which a channel may be seen.
unsigned kindsOf(uint32_t channel) {
  const unsigned kind = csy::kindOfChannel(channel);
  return kind == 0 || kind == csy::kModule ? kind : kind | csy::kCmd | csy::kTrf;
}

/// `%IW1.4.3.2` has one number after the channel, a bit of a word two.
std::optional<csy::Register> registerOf(const DirectAddress &address, const Named &target) {
  const csy::RegisterArea area = areaOf(address.area);
  const uint8_t kind = csy::kindOfChannel(target.channel.number);
  const auto rest = target.rest;
  // A bit of %I and %Q has a letter at most; one of a word is written with the word.
  const bool bitOfWord = rest.size() == 2 && address.size == 'W';
  if (rest.size() != (bitOfWord ? 2 : 1))
    return std::nullopt;
  csy::Register found{};
  for (size_t i = 0; csy::registerAt(kind, i, found); ++i) {
    const csy::RegisterRow &row = *found.row;
    if (row.area != area ||
        row.type != (bitOfWord ? csy::RegisterType::Bool : typeOf(address.size)))
      continue;
    if (found.word == csy::kNoWord) {
      const bool isError = row.bit == csy::kErrorBit;
      if (isError == (rest[0] == DirectAddress::kError) && (isError || row.bit == rest[0]) &&
          address.size == 'X')
        return found;
    } else if (found.word == rest[0] && (!bitOfWord || row.bit == rest[1])) {
      return found;
    }
  }
  return std::nullopt;
}

} // namespace

bool isRegister(const Context &c, const DirectAddress &address) {
  if (address.area == 'C' || address.size == 'F')
    return true;
  return address.numbers.size() >= 3 && named(c, address).has_value();
}

static Diagnostic &reportNoModule(Context &c, const DirectAddress &address) {
  auto &d =
      refuse(c, address, "no module of this project is at `" + std::string(address.text) + "`",
             "rack and slot of a module are needed here");
  d.note(c.program.settings.modules.empty()
             ? "stride.toml has no [[csy]]"
             : "addresses of a module are written `%IW1.4.3.2`: rack, slot, channel, register");
  return d.help("add a module to stride.toml: `[[csy]]` with `rack` and `slot`");
}

std::optional<RegisterPlace> locateRegister(Context &c, const DirectAddress &address) {
  const auto target = named(c, address);
  if (!target) {
    reportNoModule(c, address);
    return std::nullopt;
  }
  const std::string text(address.text);
  const uint8_t kind = csy::kindOfChannel(target->channel.number);
  if (kind == 0) {
    refuse(c, address, "`" + text + "` names no channel of a TSX CSY 85",
           "the channels are 0 to 31, and MOD");
    return std::nullopt;
  }
  const auto found = registerOf(address, *target);
  if (!found) {
    refuse(c, address, "`" + text + "` is no register of " + csy::nameOfKind(kind),
           "no such register")
        .note("the registers of each channel, with their names and addresses, are listed in "
              "docs/csy.md");
    return std::nullopt;
  }
  reserveModule(c, target->channel.module);
  return RegisterPlace{locationOf(target->channel, found->row->area, csy::placeOf(*found)),
                       typeOf(found->row->type)};
}

void placeAtRegister(Context &c, VarSymbol *variable) {
  const DirectAddress &address = *variable->decl->address;
  const auto place = locateRegister(c, address);
  if (!place)
    return;
  if (place->type == variable->type) {
    variable->location = c.arena.make<Location>(place->at);
    return;
  }
  c.report(Code::AddressType, address.span,
           "`" + std::string(address.text) + "` is " + typeName(place->type) + ", `" +
               std::string(variable->name.text) + "` is " + typeName(variable->type),
           "a register of a module")
      .help("declare the variable as " + typeName(place->type));
}

void placeAtChannel(Context &c, VarSymbol *variable) {
  const DirectAddress &address = *variable->decl->address;
  const auto target = named(c, address);
  if (!target) {
    reportNoModule(c, address);
    return;
  }
  const std::string type = typeName(variable->type);
  const unsigned kinds = kindsOf(target->channel.number);
  std::string allowed;
  for (unsigned kind = 1; kind <= csy::kModule; kind *= 2) {
    if ((kinds & kind) == 0)
      continue;
    const char *const name = csy::nameOfKind(static_cast<uint8_t>(kind));
    if (type == name && target->rest.empty())
      return reserveModule(c, target->channel.module);
    allowed += (allowed.empty() ? "" : ", ") + std::string(name);
  }
  auto &d = c.report(Code::AddressType, address.span,
                     "a variable of type " + type + " cannot stand for the channel `" +
                         std::string(address.text) + "`",
                     "a channel of a module");
  if (!allowed.empty())
    d.help("the types of this channel are " + allowed);
}

/// The variable `AT %CH…` on the way of a path; null: none is.
static const VarSymbol *channelOf(const StatePath &path) {
  const auto stands = [](const Symbol *symbol) -> const VarSymbol * {
    if (symbol == nullptr || symbol->kind != SymbolKind::Variable)
      return nullptr;
    const auto *variable = static_cast<const VarSymbol *>(symbol);
    return variable->decl != nullptr && variable->decl->address != nullptr &&
                   variable->decl->address->area == 'C'
               ? variable
               : nullptr;
  };
  if (const VarSymbol *found = stands(path.root))
    return found;
  for (const PathStep &step : path.steps)
    if (const VarSymbol *found = stands(step.member))
      return found;
  return nullptr;
}

void placeChannelFields(Context &c, std::vector<SlotPlace> &slots) {
  for (SlotPlace &slot : slots) {
    const VarSymbol *variable = channelOf(slot.path);
    if (variable == nullptr || slot.decl != nullptr)
      continue;
    slot.decl = variable->decl; // also a wrong one is not missing
    const auto target = named(c, *variable->decl->address);
    if (!target || isError(variable->type))
      continue;
    const std::string type = typeName(variable->type);
    const bool inStop = hasAttribute(variable->decl->attributes, AttributeId::CsyStop);
    for (unsigned kind = 1; kind <= csy::kModule; kind *= 2) {
      if (type != csy::nameOfKind(static_cast<uint8_t>(kind)))
        continue;
      csy::Register found{};
      for (size_t i = 0; csy::registerAt(static_cast<uint8_t>(kind), i, found); ++i)
        if (slot.variable->name.text == found.symbol) {
          slot.at = locationOf(target->channel, found.row->area, csy::placeOf(found));
          if (inStop && found.row->area == csy::RegisterArea::Output)
            slot.at.byte += csy::kStopOutputs;
          slot.placed = true;
        }
    }
  }
}

} // namespace stc::sema
