// Online change of random types: two builds that differ by random edits, random values, random
// pointers. An oracle that knows the edits, and nothing of the implementation's tables, says what
// each variable of the new state must hold: it maps paths of identities (numbers that survive
// renaming) to values.
#include "runtime/app/carry_over.hpp"
#include "tests/property/random_builds.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace stride;
using stride::test::AppModel;
using stride::test::ModelField;
using stride::test::ModelRoot;
using stride::test::ModelType;
using stride::test::World;

// --- the oracle ----------------------------------------------------------------------------------

/// An object of a state, known by the identities on the way to it.
struct Object {
  std::string id;
  const ModelType *type;
  uint64_t offset;
  bool held; ///< CONSTANT or init_on_onlchange on the way.
  bool leaf;
};

bool isStructure(const ModelType *t) {
  return t->kind == Kind::Struct || t->kind == Kind::FunctionBlock;
}

void collect(const ModelType *type, const std::string &id, uint64_t offset, bool held,
             std::vector<Object> &out) {
  const bool leaf = !isStructure(type) && type->kind != Kind::Array;
  out.push_back({id, type, offset, held, leaf});
  if (type->kind == Kind::Array) {
    for (uint64_t i = 0; i < type->count; ++i)
      collect(type->element, id + "[" + std::to_string(type->low + static_cast<int64_t>(i)) + "]",
              offset + i * type->element->size, held, out);
  }
  if (type->kind == Kind::Union) { // its value is one leaf; pointers may point to its fields
    for (const ModelField &f : type->fields)
      out.push_back({id + "." + std::to_string(f.id), f.type, offset, held, false});
  }
  if (!isStructure(type))
    return;
  // The base's fields are the heir's own; the base as an object of its own has another id.
  const auto fields = [&](const ModelType *owner, const auto &self) -> void {
    if (owner->base != nullptr) {
      out.push_back({id + "^" + owner->base->name, owner->base, offset, held, false});
      self(owner->base, self);
    }
    for (size_t i = 0; i < owner->fields.size(); ++i) {
      const ModelField &f = owner->fields[i];
      collect(f.type, id + "." + std::to_string(f.id), offset + owner->offsets[i],
              held || (f.flags & (kSymConstant | kSymInitOnChange)) != 0, out);
    }
  };
  fields(type, fields);
}

std::vector<Object> objectsOf(const AppModel &model) {
  std::vector<Object> out;
  for (const ModelRoot &root : model.roots)
    collect(root.type, std::to_string(root.id), root.offset,
            (root.flags & (kSymConstant | kSymInitOnChange)) != 0, out);
  return out;
}

/// Whether each value of a number type is one of another: by what the types can hold.
bool holdsAll(Kind from, Kind to) {
  struct Range {
    long double low, high;
    int digits; ///< of a real's mantissa, 0 for integers
    int family; ///< numbers, TIME
  };
  const auto range = [](Kind k) -> Range {
    switch (k) {
    case Kind::SINT:
      return {-128, 127, 0, 0};
    case Kind::INT:
      return {-32768, 32767, 0, 0};
    case Kind::DINT:
      return {-2147483648.0L, 2147483647, 0, 0};
    case Kind::LINT:
      return {-9223372036854775808.0L, 9223372036854775807.0L, 0, 0};
    case Kind::UINT:
    case Kind::WORD:
      return {0, 65535, 0, 0};
    case Kind::DWORD:
      return {0, 4294967295.0L, 0, 0};
    case Kind::ULINT:
      return {0, 18446744073709551615.0L, 0, 0};
    case Kind::REAL:
      return {-1e38L, 1e38L, 24, 0};
    case Kind::LREAL:
      return {-1e308L, 1e308L, 53, 0};
    case Kind::TIME:
      return {0, 1, 0, 1};
    case Kind::LTIME:
      return {0, 2, 0, 1};
    default:
      return {0, 0, 0, static_cast<int>(k) + 2};
    }
  };
  const Range a = range(from);
  const Range b = range(to);
  if (a.family != b.family || a.low < b.low || a.high > b.high)
    return from == to;
  if (b.digits == 0)
    return a.digits == 0;
  if (a.digits != 0)
    return a.digits <= b.digits;
  return std::max(-a.low, a.high) <= std::pow(2.0L, b.digits);
}

template <class T> T read(const std::byte *at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

long double numberAt(Kind kind, const std::byte *at) {
  switch (kind) {
  case Kind::SINT:
    return read<int8_t>(at);
  case Kind::INT:
    return read<int16_t>(at);
  case Kind::DINT:
    return read<int32_t>(at);
  case Kind::LINT:
  case Kind::LTIME:
    return static_cast<long double>(read<int64_t>(at));
  case Kind::UINT:
  case Kind::WORD:
    return read<uint16_t>(at);
  case Kind::DWORD:
  case Kind::TIME:
    return read<uint32_t>(at);
  case Kind::ULINT:
    return static_cast<long double>(read<uint64_t>(at));
  case Kind::REAL:
    return static_cast<long double>(read<float>(at));
  case Kind::LREAL:
    return static_cast<long double>(read<double>(at));
  default:
    return read<uint8_t>(at);
  }
}

template <class T> void put(std::byte *at, long double value) {
  const T own = static_cast<T>(value);
  std::memcpy(at, &own, sizeof own);
}

void putNumber(Kind kind, long double value, std::byte *at) {
  switch (kind) {
  case Kind::INT:
    return put<int16_t>(at, value);
  case Kind::DINT:
    return put<int32_t>(at, value);
  case Kind::LINT:
  case Kind::LTIME:
    return put<int64_t>(at, value);
  case Kind::UINT:
  case Kind::WORD:
    return put<uint16_t>(at, value);
  case Kind::DWORD:
    return put<uint32_t>(at, value);
  case Kind::ULINT:
    return put<uint64_t>(at, value);
  case Kind::REAL:
    return put<float>(at, value);
  case Kind::LREAL:
    return put<double>(at, value);
  default:
    FAIL() << "not a target of a conversion";
  }
}

bool isNumber(const ModelType *t) { return t->kind >= Kind::BOOL && t->kind <= Kind::LDT; }
bool isText(const ModelType *t) { return t->kind == Kind::STRING || t->kind == Kind::WSTRING; }

class Oracle {
public:
  Oracle(World &world, const std::byte *oldState, const std::byte *newState)
      : oldState_(oldState), newState_(newState), olds_(objectsOf(world.before)),
        news_(objectsOf(world.after)) {
    for (const Object &o : olds_)
      oldById_[o.id] = &o;
    for (const Object &o : news_)
      newById_[o.id] = &o;
  }

  const std::vector<Object> &olds() const { return olds_; }
  const std::vector<Object> &news() const { return news_; }
  uint64_t nulled = 0;

  /// The bytes that a leaf of the new state must have.
  std::vector<std::byte> expected(const Object &leaf) {
    std::vector<std::byte> bytes(newState_ + leaf.offset,
                                 newState_ + leaf.offset + leaf.type->size);
    const auto found = oldById_.find(leaf.id);
    if (found == oldById_.end() || leaf.held || found->second->held || !found->second->leaf)
      return bytes;
    const ModelType *from = found->second->type;
    const ModelType *to = leaf.type;
    const std::byte *value = oldState_ + found->second->offset;
    const auto copy = [&](uint64_t size) { std::memcpy(bytes.data(), value, size); };
    if (isNumber(from) && isNumber(to)) {
      if (from->kind == to->kind)
        copy(to->size);
      else if (holdsAll(from->kind, to->kind))
        putNumber(to->kind,
                  numberAt(from->kind, value) * (from->kind == Kind::TIME ? 1000000.0L : 1.0L),
                  bytes.data());
    } else if (isText(from) && from->kind == to->kind) {
      const uint64_t unit = from->kind == Kind::WSTRING ? 2 : 1;
      std::vector<std::byte> text(to->size);
      for (uint64_t i = 0; i < std::min(from->length, to->length); ++i) {
        if (std::all_of(value + i * unit, value + (i + 1) * unit,
                        [](std::byte b) { return b == std::byte{0}; }))
          break;
        std::memcpy(text.data() + i * unit, value + i * unit, unit);
      }
      if (from->length == to->length)
        copy(to->size);
      else
        bytes = text;
    } else if (from->kind == Kind::Enum && to->kind == Kind::Enum && from->name == to->name) {
      const std::optional<int16_t> number = enumerator(from, to, read<int16_t>(value));
      if (number)
        std::memcpy(bytes.data(), &*number, 2);
    } else if (from->kind == Kind::Enum && isNumber(to) && holdsAll(Kind::INT, to->kind)) {
      if (to->kind == Kind::INT)
        copy(2);
      else
        putNumber(to->kind, read<int16_t>(value), bytes.data());
    } else if (from->kind == Kind::Union && to->kind == Kind::Union && from->name == to->name) {
      copy(commonBytes(from, to));
    } else if (from->kind == Kind::Pointer && to->kind == Kind::Pointer) {
      const uint64_t address = pointer(read<uint64_t>(value), from->element, to->element);
      std::memcpy(bytes.data(), &address, 8);
    }
    return bytes;
  }

private:
  static std::optional<int16_t> enumerator(const ModelType *from, const ModelType *to,
                                           int16_t value) {
    const auto named = [](const ModelType *t, const std::string &name) {
      return std::find_if(t->enumerators.begin(), t->enumerators.end(),
                          [&](const auto &e) { return e.first == name; });
    };
    for (const auto &[name, number] : from->enumerators) {
      if (number != value)
        continue;
      const auto again = named(to, name);
      if (again != to->enumerators.end())
        return static_cast<int16_t>(again->second);
      for (const auto &[other, otherNumber] : to->enumerators) {
        if (otherNumber == value && named(from, other) == from->enumerators.end())
          return value; // renamed
      }
      return std::nullopt;
    }
    return value; // a number without a name
  }

  static uint64_t commonBytes(const ModelType *from, const ModelType *to) {
    uint64_t size = 0;
    for (const ModelField &f : from->fields) {
      for (const ModelField &g : to->fields) {
        if (f.id == g.id && f.type->kind == g.type->kind)
          size = std::max(size, f.type->size);
      }
    }
    return size;
  }

  /// Whether a byte pointer to the old object may go on to the new one.
  static bool sameMemory(const ModelType *from, const ModelType *to) {
    if (isNumber(from))
      return from->kind == to->kind;
    if (from->kind == Kind::Enum) {
      if (to->kind != Kind::Enum || from->name != to->name)
        return false;
      return std::all_of(from->enumerators.begin(), from->enumerators.end(), [&](const auto &e) {
        return enumerator(from, to, static_cast<int16_t>(e.second)) == e.second;
      });
    }
    return carried(from, to);
  }

  /// Whether anything of a value can be carried over.
  static bool carried(const ModelType *from, const ModelType *to) {
    if (isNumber(from) && isNumber(to))
      return holdsAll(from->kind, to->kind);
    if (from->kind == Kind::Enum && isNumber(to))
      return holdsAll(Kind::INT, to->kind);
    if (from->kind != to->kind)
      return false;
    if (from->kind == Kind::Array)
      return std::max(from->low, to->low) <= std::min(from->low + static_cast<int64_t>(from->count),
                                                      to->low + static_cast<int64_t>(to->count)) -
                                                 1 &&
             carried(from->element, to->element);
    if (from->kind == Kind::Union)
      return from->name == to->name && commonBytes(from, to) != 0;
    return true;
  }

  uint64_t pointer(uint64_t address, const ModelType *from, const ModelType *to) {
    if (address == 0)
      return 0;
    const std::optional<uint64_t> target =
        follow(address - std::bit_cast<uint64_t>(oldState_), from, to);
    if (!target) {
      ++nulled;
      return 0;
    }
    return std::bit_cast<uint64_t>(newState_) + *target;
  }

  const Object *counterpart(const Object &old) const {
    const auto found = newById_.find(old.id);
    return found == newById_.end() ? nullptr : found->second;
  }

  bool startsAt(uint64_t offset, const ModelType *type) const {
    return std::any_of(news_.begin(), news_.end(),
                       [&](const Object &o) { return o.offset == offset && o.type == type; });
  }

  std::optional<uint64_t> follow(uint64_t offset, const ModelType *from,
                                 const ModelType *to) const {
    for (const bool end : {false, true}) {
      bool found = false;
      for (const Object &o : olds_) {
        if (o.type != from || o.offset + (end ? o.type->size : 0) != offset)
          continue;
        found = true; // there are several only in unions: any of them will do
        const Object *const n = counterpart(o);
        if (n != nullptr && (n->type == to || (!end && startsAt(n->offset, to))))
          return n->offset + (end ? n->type->size : 0);
      }
      if (found)
        return std::nullopt;
    }
    // not an object of the pointer's own type: the largest that starts there
    const Object *largest = nullptr;
    for (const Object &o : olds_) {
      if (o.offset == offset && (largest == nullptr || o.type->size > largest->type->size))
        largest = &o;
    }
    if (largest != nullptr) {
      const Object *const n = counterpart(*largest);
      if (n == nullptr || !sameMemory(largest->type, n->type))
        return std::nullopt;
      return n->offset;
    }
    for (const Object &o : olds_) {
      if (!o.leaf || o.offset >= offset || offset - o.offset >= o.type->size)
        continue;
      const Object *const n = counterpart(o);
      if (n == nullptr || n->type->kind != o.type->kind)
        return std::nullopt;
      if (isText(o.type) ? offset - o.offset >= n->type->size : !sameMemory(o.type, n->type))
        return std::nullopt;
      return n->offset + (offset - o.offset);
    }
    return std::nullopt;
  }

  const std::byte *oldState_;
  const std::byte *newState_;
  std::vector<Object> olds_;
  std::vector<Object> news_;
  std::map<std::string, const Object *> oldById_;
  std::map<std::string, const Object *> newById_;
};

/// Random values everywhere, and pointers that point somewhere.
void fillOld(World &world, const std::vector<Object> &objects, std::byte *state, uint64_t size) {
  for (uint64_t i = 0; i < size; ++i)
    state[i] = static_cast<std::byte>(world.bits());
  for (const Object &o : objects) {
    std::byte *at = state + o.offset;
    if (o.type->kind == Kind::REAL) {
      put<float>(at, static_cast<long double>(world.pick(-100000, 100000)) / 7);
    } else if (o.type->kind == Kind::Enum) {
      const auto &names = o.type->enumerators;
      const int16_t value =
          world.chance(10) || names.empty()
              ? static_cast<int16_t>(world.pick(-5, 20))
              : static_cast<int16_t>(
                    names[static_cast<size_t>(world.pick(0, static_cast<int>(names.size()) - 1))]
                        .second);
      std::memcpy(at, &value, 2);
    } else if (isText(o.type) && world.chance(70)) {
      const uint64_t unit = o.type->kind == Kind::WSTRING ? 2 : 1;
      std::memset(at +
                      unit * static_cast<uint64_t>(world.pick(0, static_cast<int>(o.type->length))),
                  0, unit);
    } else if (o.type->kind == Kind::Pointer) {
      uint64_t address = 0;
      const ModelType *to = o.type->element;
      std::vector<const Object *> targets;
      for (const Object &t : objects) {
        if (t.type == to || (to->kind == Kind::BYTE && t.type->kind != Kind::Union))
          targets.push_back(&t);
      }
      if (world.chance(4)) {
        address = std::bit_cast<uint64_t>(state) + size + 100; // outside
      } else if (!targets.empty() && world.chance(90)) {
        const Object &t =
            *targets[static_cast<size_t>(world.pick(0, static_cast<int>(targets.size()) - 1))];
        address = std::bit_cast<uint64_t>(state) + t.offset;
        if (to->kind != Kind::BYTE && world.chance(25))
          address += t.type->size; // one past the end
        else if (to->kind == Kind::BYTE && t.leaf && world.chance(50))
          address += static_cast<uint64_t>(world.pick(0, static_cast<int>(t.type->size) - 1));
      }
      std::memcpy(at, &address, 8);
    }
  }
}

void checkWorld(uint64_t seed) {
  World world(seed);
  const uint64_t oldSize = world.before.app().stateSize;
  const uint64_t newSize = world.after.app().stateSize;
  std::vector<uint64_t> oldMemory(oldSize / 8 + 1);
  std::vector<uint64_t> newMemory(newSize / 8 + 1);
  auto *const oldState = reinterpret_cast<std::byte *>(oldMemory.data());
  auto *const newState = reinterpret_cast<std::byte *>(newMemory.data());
  fillOld(world, objectsOf(world.before), oldState, oldSize);
  for (uint64_t i = 0; i < newSize; ++i)
    newState[i] = static_cast<std::byte>(world.bits());
  Oracle oracle(world, oldState, newState);
  std::vector<std::pair<const Object *, std::vector<std::byte>>> expected;
  for (const Object &o : oracle.news()) {
    if (o.leaf)
      expected.emplace_back(&o, oracle.expected(o));
  }
  const app::CarryOver plan(world.before.app(), world.after.app());
  app::CarryResult result;
  plan.apply(oldState, newState, result);
  for (const auto &[object, bytes] : expected) {
    if (std::memcmp(newState + object->offset, bytes.data(), bytes.size()) != 0)
      RC_FAIL("seed " + std::to_string(seed) + ": object " + object->id + " : " +
              object->type->name + "\n" + plan.report().text(true));
  }
  RC_ASSERT(result.nulled() == oracle.nulled);
  for (const std::string &line : plan.describe(result, oldState))
    RC_ASSERT(!line.empty());
  // The same build again: a move to another place.
  std::vector<uint64_t> moved(oldMemory.size());
  auto *const movedState = reinterpret_cast<std::byte *>(moved.data());
  const app::CarryOver move(world.before.app(), world.before.app());
  RC_ASSERT(move.report().verdict() == app::Verdict::Silent);
  move.apply(oldState, movedState, result);
  for (const Object &o : objectsOf(world.before)) {
    if (o.leaf && !o.held && o.type->kind != Kind::Pointer)
      RC_ASSERT(std::memcmp(movedState + o.offset, oldState + o.offset, o.type->size) == 0);
    if (o.leaf && !o.held && o.type->kind == Kind::Pointer) {
      const uint64_t was = read<uint64_t>(oldState + o.offset);
      const uint64_t inside = was - std::bit_cast<uint64_t>(oldState);
      RC_ASSERT(read<uint64_t>(movedState + o.offset) ==
                (was == 0 || inside > oldSize ? 0 : std::bit_cast<uint64_t>(movedState) + inside));
    }
  }
}

RC_GTEST_PROP(CarryOverProperty, EveryVariableHoldsWhatItsIdentityHeld, (uint64_t seed)) {
  for (uint64_t i = 0; i < 25; ++i)
    checkWorld(seed * 1000003 + i);
}

} // namespace
