// Two builds of a random application that differ by random edits.
#ifndef STRIDE_TESTS_PROPERTY_RANDOM_BUILDS_HPP
#define STRIDE_TESTS_PROPERTY_RANDOM_BUILDS_HPP

#include "runtime/app/validate.hpp"
#include "tests/unit/app/app_model.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace stride::test {

/// A type as written; named types and enumerations by number.
struct Shape {
  enum class What { Elementary, Text, Array, Named, Enumeration, Pointer };
  What what = What::Elementary;
  Kind kind = Kind::INT; ///< Elementary; Text: STRING or WSTRING.
  uint32_t length = 0;
  int64_t low = 0;
  int64_t high = 0;
  int number = -1;            ///< Named, Enumeration; Pointer to a named type.
  std::vector<Shape> element; ///< Array: one.
};

struct Field {
  int id;
  std::string name;
  std::string renamedFrom;
  Shape shape;
  uint32_t flags = 0;
};

struct Named {
  Kind kind = Kind::Struct;
  int base = -1;
  std::vector<Field> before;
  std::vector<Field> after;
};

struct Enumeration {
  std::vector<std::pair<std::string, int64_t>> before;
  std::vector<std::pair<std::string, int64_t>> after;
};

constexpr Kind kElementary[] = {Kind::BOOL,  Kind::SINT, Kind::INT,   Kind::DINT,  Kind::LINT,
                                Kind::UINT,  Kind::WORD, Kind::DWORD, Kind::ULINT, Kind::REAL,
                                Kind::LREAL, Kind::TIME, Kind::LTIME};

class World {
public:
  explicit World(uint64_t seed) : engine_(seed) {
    const int enums = pick(1, 2);
    for (int i = 0; i < enums; ++i)
      enumerations.push_back(enumeration());
    const int count = pick(1, 6);
    for (int i = 0; i < count; ++i)
      named.push_back(namedType(i));
    for (int i = pick(1, 8); i > 0; --i)
      rootsBefore.push_back(field(count));
    rootsAfter = edited(rootsBefore, count);
    build(before, false);
    build(after, true);
  }

  int pick(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  bool chance(int percent) { return pick(1, 100) <= percent; }
  uint64_t bits() { return engine_(); }

  AppModel before;
  AppModel after;
  std::vector<Enumeration> enumerations;
  std::vector<Named> named;
  std::vector<Field> rootsBefore;
  std::vector<Field> rootsAfter;

private:
  Kind kind() { return kElementary[static_cast<size_t>(pick(0, std::size(kElementary) - 1))]; }

  /// Types below `limit` may be contained.
  Shape shape(int limit, int depth) {
    Shape s;
    const int dice = pick(1, 100);
    if (dice <= 40 || depth > 3) {
      s.kind = kind();
    } else if (dice <= 48) {
      s.what = Shape::What::Text;
      s.kind = chance(70) ? Kind::STRING : Kind::WSTRING;
      s.length = static_cast<uint32_t>(pick(1, 9));
    } else if (dice <= 54) {
      s.what = Shape::What::Enumeration;
      s.number = pick(0, static_cast<int>(enumerations.size()) - 1);
    } else if (dice <= 70) {
      s.what = Shape::What::Pointer; // to a named type, BYTE or LREAL
      s.number = chance(50) ? pick(0, 7) : -1;
      s.kind = chance(50) ? Kind::BYTE : Kind::LREAL;
    } else if (dice <= 84 || limit == 0) {
      s.what = Shape::What::Array;
      s.low = pick(-2, 2);
      s.high = s.low + pick(0, 3);
      s.element.push_back(shape(limit, depth + 1));
    } else {
      s.what = Shape::What::Named;
      s.number = pick(0, limit - 1);
    }
    return s;
  }

  uint32_t flags() {
    const uint32_t held = chance(94)   ? 0
                          : chance(50) ? uint32_t{kSymConstant}
                                       : uint32_t{kSymInitOnChange};
    const uint32_t retained = chance(75)   ? 0
                              : chance(50) ? uint32_t{kSymRetain}
                                           : uint32_t{kSymPersistent};
    return held | retained;
  }

  Field field(int limit) {
    const int id = ++ids_;
    return {id, "f" + std::to_string(id), {}, shape(limit, 0), flags()};
  }

  Shape edited(const Shape &old, int limit) {
    Shape s = old;
    switch (old.what) {
    case Shape::What::Elementary:
      s.kind = kind();
      break;
    case Shape::What::Text:
      s.length = static_cast<uint32_t>(pick(1, 9));
      break;
    case Shape::What::Array:
      if (chance(50)) {
        s.low += pick(-2, 2);
        s.high = s.low + pick(0, 3);
      } else {
        s.element[0] = edited(old.element[0], limit);
      }
      break;
    default:
      s = Shape{}; // something else entirely
      s.kind = kind();
      break;
    }
    return s;
  }

  std::vector<Field> edited(const std::vector<Field> &old, int limit) {
    std::vector<Field> out;
    for (const Field &f : old) {
      if (chance(12))
        continue;
      Field g = f;
      if (chance(10)) {
        g.renamedFrom = f.name;
        g.name += "r";
      }
      if (chance(15))
        g.shape = edited(f.shape, limit);
      out.push_back(std::move(g));
    }
    while (chance(30))
      out.push_back(field(limit));
    if (chance(35))
      std::shuffle(out.begin(), out.end(), engine_);
    return out;
  }

  Named namedType(int number) {
    Named n;
    const int dice = pick(1, 10);
    n.kind = dice <= 5 ? Kind::Struct : dice <= 9 ? Kind::FunctionBlock : Kind::Union;
    if (n.kind == Kind::Union) {
      for (int i = pick(1, 3); i > 0; --i) {
        Field f = field(0);
        f.flags = 0;
        f.shape = Shape{};
        f.shape.kind = kind();
        n.before.push_back(std::move(f));
      }
      n.after = edited(n.before, 0);
      for (Field &f : n.after) { // added ones
        f.flags = 0;
        if (f.shape.what != Shape::What::Elementary)
          f.shape = Shape{};
      }
      if (n.after.empty())
        n.after = n.before;
      return n;
    }
    for (int i = pick(0, 6); i > 0; --i)
      n.before.push_back(field(number));
    n.after = edited(n.before, number);
    for (int i = 0; i < number && n.base < 0; ++i) {
      if (named[static_cast<size_t>(i)].kind == n.kind && chance(30))
        n.base = i;
    }
    // A field moves between the base and its heir. Other heirs of the base get it as well.
    if (n.base >= 0 && chance(20)) {
      Named &base = named[static_cast<size_t>(n.base)];
      std::vector<Field> &from = chance(50) ? n.after : base.after;
      std::vector<Field> &to = &from == &n.after ? base.after : n.after;
      const auto fits = [&](const Field &f) { // the base may contain only what stands before it
        return &from != &n.after || limitOf(f.shape) < n.base;
      };
      if (!from.empty() && fits(from.back())) {
        to.push_back(from.back());
        from.pop_back();
      }
    }
    return n;
  }

  static int limitOf(const Shape &s) {
    return s.what == Shape::What::Array   ? limitOf(s.element[0])
           : s.what == Shape::What::Named ? s.number
                                          : -1;
  }

  Enumeration enumeration() {
    Enumeration e;
    for (int i = pick(1, 5); i > 0; --i)
      e.before.emplace_back("e" + std::to_string(++ids_), static_cast<int64_t>(e.before.size()));
    for (const auto &[name, value] : e.before) {
      if (chance(15))
        continue;
      e.after.emplace_back(chance(10) ? name + "r" : name, value);
    }
    if (chance(40))
      e.after.emplace_back("e" + std::to_string(++ids_), pick(0, 6));
    if (chance(30)) { // numbered anew
      std::shuffle(e.after.begin(), e.after.end(), engine_);
      for (size_t i = 0; i < e.after.size(); ++i)
        e.after[i].second = static_cast<int64_t>(i);
    }
    // each number once
    std::set<int64_t> seen;
    std::erase_if(e.after, [&](const auto &x) { return !seen.insert(x.second).second; });
    return e;
  }

  void build(AppModel &model, bool isAfter) {
    std::vector<const ModelType *> enums;
    for (size_t i = 0; i < enumerations.size(); ++i)
      enums.push_back(model.enumeration("E" + std::to_string(i),
                                        isAfter ? enumerations[i].after : enumerations[i].before));
    std::vector<ModelType *> types;
    for (size_t i = 0; i < named.size(); ++i)
      types.push_back(model.structure("T" + std::to_string(i), {}, nullptr, named[i].kind));
    const std::function<const ModelType *(const Shape &)> make = [&](const Shape &s) {
      switch (s.what) {
      case Shape::What::Elementary:
        return model.elementary(s.kind);
      case Shape::What::Text:
        return model.string(s.length, s.kind == Kind::WSTRING);
      case Shape::What::Array:
        return model.array(make(s.element[0]), s.low, s.high);
      case Shape::What::Named:
        return static_cast<const ModelType *>(types[static_cast<size_t>(s.number)]);
      case Shape::What::Enumeration:
        return enums[static_cast<size_t>(s.number)];
      case Shape::What::Pointer:
        break;
      }
      return model.pointer(s.number >= 0 ? types[static_cast<size_t>(s.number) % types.size()]
                                         : model.elementary(s.kind));
    };
    for (size_t i = 0; i < named.size(); ++i) {
      if (named[i].base >= 0)
        types[i]->base = types[static_cast<size_t>(named[i].base)];
      std::vector<ModelField> fields;
      for (const Field &f : isAfter ? named[i].after : named[i].before)
        fields.push_back({f.name, make(f.shape), f.flags, f.renamedFrom, f.id});
      AppModel::define(*types[i], std::move(fields));
    }
    for (const Field &f : isAfter ? rootsAfter : rootsBefore)
      model.root("G", f.name, make(f.shape), f.flags, f.renamedFrom, f.id);
    model.finish();
    app::validate(model.app(), {});
  }

  std::mt19937_64 engine_;
  int ids_ = 0;
};

} // namespace stride::test

#endif
