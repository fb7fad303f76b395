// Direct addresses: the places they name, and what may lie there.

#include "compiler/semantics/config/config.hpp"

#include "compiler/semantics/builtins/builtin_calls.hpp"
#include "compiler/semantics/config/internal.hpp"
#include "compiler/semantics/config/registers.hpp"
#include "compiler/semantics/context/context.hpp"
#include "compiler/semantics/context/describe.hpp"
#include "compiler/semantics/fold.hpp"
#include "compiler/semantics/held.hpp"
#include "compiler/semantics/locations.hpp"
#include "compiler/syntax/attributes.hpp"

#include <algorithm>

namespace stc::sema {

using namespace ast;

static bool locateType(Context &c, VarSymbol *variable, uint64_t bytes, bool isBool);

namespace {

/// Bytes of one area; an address after is a slip of the pen.
constexpr uint64_t kMaxArea = uint64_t{1} << 24;

/// Pointers, references and instances cannot lie in memory that others write byte by byte.
bool holdsAddress(const Type *type) {
  return anyHeld(type, [](const Type *t, const VarSymbol *) {
    return t->kind == TypeKind::Structure  ? Held::Inside
           : isElementary(t) || isError(t) ? Held::Over
                                           : Held::Found;
  });
}

} // namespace

namespace {

Location placeAt(const DirectAddress &address, uint64_t byte) {
  Location at;
  at.area = address.area == 'I' ? Area::Input : address.area == 'Q' ? Area::Output : Area::Memory;
  at.byte = static_cast<uint32_t>(byte);
  return at;
}

std::optional<Location> byteAt(Context &c, const DirectAddress &address, uint64_t byte) {
  if (byte >= kMaxArea) {
    reserve(c, address, byte, 1);
    return std::nullopt;
  }
  return placeAt(address, byte);
}

/// V2.3 numbers the segments of memory: there is one.
std::span<const uint32_t> withoutSegment(const DirectAddress &address) {
  const std::span<const uint32_t> numbers = address.numbers;
  const bool segment = address.size == 'X' && numbers.size() == 3 && numbers.front() == 0;
  return segment ? numbers.subspan(1) : numbers;
}

/// Bit `number` of the unit of `width` bits that begins at byte `base`.
std::optional<Location> bitAt(Context &c, const DirectAddress &address, uint64_t base,
                              uint32_t number, unsigned width) {
  if (number >= width) {
    auto &d = c.report(Code::AddressBeyond, address.span,
                       "`" + std::string(address.text) + "` has no bit " + std::to_string(number),
                       "the bits are 0 to " + std::to_string(width - 1));
    if (address.size == 'X') {
      d.help("the number before the dot counts " +
             std::string(width == 8 ? "bytes: this bit is `%" : "words: this bit is `%") +
             address.area + 'X' + std::to_string(withoutSegment(address).front() + number / width) +
             "." + std::to_string(number % width) + "`");
    }
    return std::nullopt;
  }
  std::optional<Location> at = byteAt(c, address, base + number / 8);
  if (at)
    at->bit = static_cast<int8_t>(number % 8);
  return at;
}

} // namespace

std::optional<Location> locate(Context &c, const DirectAddress &address) {
  const std::span<const uint32_t> numbers = withoutSegment(address);
  if (numbers.empty())
    return std::nullopt; // reported by the scanner
  const Addressing addressing = c.program.settings.addressing;
  if (address.size == 'X') {
    if (numbers.size() == 1)
      return bitAt(c, address, numbers[0] / 8, numbers[0] % 8, 8);
    if (numbers.size() == 2)
      return addressing == Addressing::Words
                 ? bitAt(c, address, uint64_t{numbers[0]} * 2, numbers[1], 16)
                 : bitAt(c, address, numbers[0], numbers[1], 8);
  } else {
    const unsigned unit = unitBytes(address.size);
    const uint64_t byte = uint64_t{numbers[0]} * (addressing == Addressing::Bytes ? 1 : unit);
    if (numbers.size() == 2)
      return bitAt(c, address, byte, numbers[1], unit * 8);
    if (numbers.size() == 1)
      return byteAt(c, address, byte);
  }
  auto &d =
      c.report(Code::AddressBeyond, address.span,
               "`" + std::string(address.text) + "` does not name a place in the process image",
               "too many numbers");
  d.note("addresses that follow the tree of a PLC configuration depend on its devices; here the "
         "process image is one row of bytes");
  d.help("write the byte and the bit: `%" + std::string(1, address.area) +
         "X3.7`; or the unit: `%" + std::string(1, address.area) + "W3`");
  return std::nullopt;
}

bool reserve(Context &c, const DirectAddress &address, uint64_t byte, uint64_t size) {
  const size_t area = address.area == 'I' ? 0 : address.area == 'Q' ? 1 : 2;
  const uint32_t configured = c.program.settings.imageBytes[area];
  const uint64_t limit = configured != 0 ? configured : kMaxArea;
  if (size > limit || byte > limit - size) {
    const char *const kKeys[] = {"inputs", "outputs", "memory"};
    auto &d = c.report(Code::AddressBeyond, address.span,
                       "`" + std::string(address.text) + "` lies beyond the end of the " +
                           std::string(areaName(static_cast<Area>(area))) + " area",
                       size <= 1 ? "this is byte " + std::to_string(byte)
                                 : "bytes " + std::to_string(byte) + " to " +
                                       std::to_string(byte + size - 1));
    if (configured != 0)
      d.help("stride.toml gives the area " + std::to_string(configured) + " bytes: enlarge `" +
             kKeys[area] + "` in [image]");
    else
      d.note("an area holds 16,777,216 bytes at most");
    return false;
  }
  uint32_t &bytes = c.program.image.bytes[area];
  bytes = std::max(bytes, static_cast<uint32_t>(byte + size));
  return true;
}

const Type *checkDirect(Context &c, DirectExpr *expr) {
  const Type *error = elementaryType(TypeKind::Error);
  const DirectAddress &address = *expr->address;
  if (address.incomplete) {
    c.report(Code::AddressNotAllowed, expr->span,
             "`" + std::string(address.text) + "` does not say where: it cannot be used as a value",
             "this address has no number")
        .help("give the number, `%" + std::string(1, address.area) +
              "W0`; or declare a variable `x AT " + std::string(address.text) + " : …`");
    return error;
  }
  if (isRegister(c, address)) {
    const auto place = locateRegister(c, address);
    if (!place)
      return error;
    expr->location = c.arena.make<Location>(place->at);
    return place->type;
  }
  const auto at = locate(c, address);
  if (!at)
    return error;
  const unsigned bytes = at->bit >= 0 ? 1 : unitBytes(address.size);
  if (!reserve(c, address, at->byte, bytes))
    return error;
  if (!c.scope.module->library->isUser) {
    c.report(Code::AddressNotAllowed, expr->span, "a library cannot use a direct address",
             "belongs to the project")
        .help("pass the value as a parameter");
    return error;
  }
  expr->location = c.arena.make<Location>(*at);
  if (at->bit >= 0)
    return elementaryType(TypeKind::Boolean);
  return elementaryType(bytes == 1   ? TypeKind::Byte
                        : bytes == 2 ? TypeKind::Word
                        : bytes == 4 ? TypeKind::Dword
                                     : TypeKind::Lword);
}

/// Whether a variable declared there may have an address; reports why not.
static bool mayBePlaced(Context &c, const VarSymbol *variable) {
  const VarDecl *decl = variable->decl;
  const DirectAddress &address = *decl->address;
  const std::string name(variable->name.text);
  const auto refuse = [&](std::string message, std::string label) -> Diagnostic & {
    return c.report(Code::AddressNotAllowed, address.span, std::move(message), std::move(label));
  };
  const DeclKind owner =
      variable->owner == nullptr ? DeclKind::Globals : variable->owner->decl->kind;
  const bool isField = variable->owner == nullptr && variable->globals == nullptr;
  if (isField && !address.incomplete)
    refuse("the field `" + name + "` of a structure cannot have an address of its own",
           "all variables of the type would lie there")
        .help(std::string("write `AT %") + address.area +
              "*`: VAR_CONFIG says where it lies, for each variable of the type");
  else if (isField && static_cast<const ast::StructDecl *>(variable->home)->isUnion)
    refuse("the member `" + name + "` of a UNION cannot have an address",
           "all members of a UNION lie at one place")
        .help("give the address to a variable of the UNION's type");
  else if (owner != DeclKind::Globals && owner != DeclKind::Program &&
           owner != DeclKind::FunctionBlock && owner != DeclKind::Class)
    refuse("a variable of " + describe(variable->owner) + " cannot have an address",
           "it exists only during the call")
        .help("declare it in VAR_GLOBAL, or in the VAR of a program or function block");
  else if (owner != DeclKind::Globals && decl->section != Section::Local &&
           (decl->section != Section::Stat || address.incomplete))
    refuse("only variables of VAR and VAR_GLOBAL can have an address",
           "`" + name + "` is declared in another section")
        .help(decl->section == Section::Input || decl->section == Section::InOut
                  ? "declare it in VAR_GLOBAL, and give it to the input in the call: `Block(" +
                        name + " := …)`"
              : decl->section == Section::Output
                  ? "declare it in VAR_GLOBAL, and assign the output to it: `Block(" + name +
                        " => …)`"
                  : std::string("declare it in VAR or in VAR_GLOBAL"));
  else if (variable->isConstant)
    refuse("the constant `" + name + "` cannot have an address", "a constant is not stored")
        .help("remove CONSTANT");
  else if (!variable->library->isUser && !address.incomplete)
    refuse("a library cannot use a direct address", "belongs to the project");
  else
    return true;
  return false;
}

/// The place in each instance that VAR_CONFIG gives.
static Location slotAt(const DirectAddress &address, bool isBool) {
  Location at;
  at.area = address.area == 'I' ? Area::Input : address.area == 'Q' ? Area::Output : Area::Memory;
  at.isSlot = true;
  at.bit = isBool ? 0 : -1;
  return at;
}

void placeVariable(Context &c, VarSymbol *variable) {
  const DirectAddress &address = *variable->decl->address;
  const Type *type = variable->type;
  if (!mayBePlaced(c, variable) || isError(type))
    return;
  if (address.area == 'C')
    return placeAtChannel(c, variable);
  if (holdsAddress(type)) {
    c.report(Code::AddressType, address.span,
             "a variable of type " + typeName(type) + " cannot lie in the process image",
             "holds addresses of other variables")
        .note("the process image is memory that the devices and other variables write byte by "
              "byte");
    return;
  }
  const bool isBool = type->kind == TypeKind::Boolean;
  const uint64_t bytes = c.storage.of(type).size;
  if (!address.incomplete && isRegister(c, address))
    return placeAtRegister(c, variable);
  // A letter after `%I` is optional before `*`.
  const bool letter = !address.incomplete || (address.text.size() > 2 && address.text[2] != '*');
  if (letter && !locateType(c, variable, bytes, isBool))
    return;
  if (address.incomplete) {
    variable->location = c.arena.make<Location>(slotAt(address, isBool));
    return;
  }
  const auto found = locate(c, address);
  if (!found)
    return;
  if (found->bit >= 0 && !isBool) { // `%MW3.2`
    c.report(Code::AddressType, address.span,
             "`" + std::string(address.text) + "` is a single bit, `" +
                 std::string(variable->name.text) + "` is " + typeName(type),
             "only a BOOL fits into a bit");
    return;
  }
  if (!reserve(c, address, found->byte, found->bit >= 0 ? 1 : bytes))
    return;
  variable->location = c.arena.make<Location>(*found);
}

/// Whether the letter of the address suits the type.
static bool locateType(Context &c, VarSymbol *variable, uint64_t bytes, bool isBool) {
  const DirectAddress &address = *variable->decl->address;
  const Type *type = variable->type;
  if (address.size == 'X' && !isBool) {
    auto &d = c.report(Code::AddressType, address.span,
                       "`" + std::string(address.text) + "` is a single bit, `" +
                           std::string(variable->name.text) + "` is " + typeName(type),
                       "only a BOOL fits into a bit");
    d.help(std::string("write the size of the type: `%") + address.area +
           (isElementary(type) ? sizeLetter(bytes) : 'B') + "…`");
    return false;
  }
  if (isBool || !isElementary(type) || isString(type) || address.size == sizeLetter(bytes))
    return true;
  c.report(Code::AddressSize, address.span,
           "`" + std::string(address.text) + "` is " + std::to_string(unitBytes(address.size) * 8) +
               " bits wide, " + typeName(type) + " is " + std::to_string(bytes * 8),
           "`" + std::string(variable->name.text) + "` begins there and is " +
               std::to_string(bytes * 8) + " bits wide")
      .help(std::string("write `%") + address.area + sizeLetter(bytes) +
            "…` for a variable of this type");
  return true;
}

/// Whether a unit test is checked, also one of its methods or actions: it plays the devices.
static bool isInTest(const Context &c) {
  for (const PouSymbol *pou = c.scope.pou; pou != nullptr; pou = pou->owner)
    if (pou->decl != nullptr && hasAttribute(pou->decl->attributes, AttributeId::Test))
      return true;
  return false;
}

void reportInputWritten(Context &c, const Expr *expr, const Location &at) {
  if (at.area != Area::Input || isInTest(c))
    return;
  c.report(Code::InputWritten, expr->span, "this writes to an input",
           "the device overwrites it at the start of the next cycle")
      .help("write to an output (%Q) or to memory (%M)");
}

const Type *checkBitAddress(Context &c, CallExpr *expr) {
  const Expr *value = expr->arguments[0].value;
  const Location *at = locationOf(value);
  if (at == nullptr || at->isSlot)
    return argumentError(c, expr, 0, "a variable with an address (`AT %IX2.3`)");
  // The highest four bits name the area.
  constexpr int64_t kAreas[] = {0x80000000LL, 0xC0000000LL, 0x40000000LL};
  const int64_t bit = int64_t{at->byte} * 8 + std::max<int64_t>(at->bit, 0);
  expr->constant = c.makeConstant(integerValue(kAreas[static_cast<size_t>(at->area)] + bit));
  return elementaryType(TypeKind::Dword);
}

void checkRetain(Context &c, const VarSymbol *variable) {
  if (variable->decl == nullptr ||
      (variable->decl->qualifiers & (kQualRetain | kQualPersistent)) == 0)
    return;
  const bool perCall =
      variable->section == Section::Temp || variable->section == Section::InOut ||
      (variable->owner != nullptr && variable->owner->type == nullptr &&
       variable->section != Section::Stat && variable->section != Section::Instance);
  const Location *const at = variable->location;
  const bool input = at != nullptr && at->area == Area::Input;
  if (!perCall && !variable->isConstant && !input) {
    if (at != nullptr && at->isSlot)
      c.report(Code::RetainWithoutEffect, variable->name.span,
               "`" + std::string(variable->name.text) + "` is not retained",
               "VAR_CONFIG says where it lies, and such places are not saved")
          .help(
              "declare it at an address of its own (`AT %MW3`), which is saved, or without AT; or "
              "remove RETAIN or PERSISTENT");
    return;
  }
  c.report(Code::RetainWithoutEffect, variable->name.span,
           "`" + std::string(variable->name.text) + "` has no value to retain",
           perCall                ? "it lives only during a call"
           : variable->isConstant ? "a constant never changes"
                                  : "the device gives its value in every cycle")
      .help("remove RETAIN or PERSISTENT, or declare the variable in a section without it");
}

void finishImage(Context &c) {
  Image &image = c.program.image;
  for (size_t area = 0; area < image.bytes.size(); ++area) {
    uint32_t &bytes = image.bytes[area];
    bytes = (std::max(bytes, c.program.settings.imageBytes[area]) + 7) / 8 * 8;
    if (bytes != 0)
      image.types[area] = c.types.array(elementaryType(TypeKind::Byte), 0, int64_t{bytes} - 1);
  }
}

} // namespace stc::sema
