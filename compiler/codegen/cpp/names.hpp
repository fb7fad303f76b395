#ifndef STRIDE_COMPILER_CODEGEN_CPP_NAMES_HPP
#define STRIDE_COMPILER_CODEGEN_CPP_NAMES_HPP
// How ST names, types and their headers are called in C++.

#include "compiler/semantics/program.hpp"

#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace stc::codegen {

/// The C++ spelling of an ST identifier: itself, with one more `_` when C++ (or Stride) uses the
/// word.
std::string mangle(std::string_view name);
/// Appends it.
void mangleTo(std::string &out, std::string_view name);

/// `T name`, `T *name`: pointers want no blank in between.
[[nodiscard]] std::string declared(std::string_view type, std::string_view mangled);

/// The field of an instance, structure or list that holds the variable.
[[nodiscard]] std::string fieldName(const VarSymbol *variable);
/// The member function of a method, action or accessor: `Run`, `Speed__get`.
[[nodiscard]] std::string methodName(const PouSymbol *method);
/// The way from an instance of `from` to its part `to`, which it is or extends: `base__.base__.`
[[nodiscard]] std::string pathToBase(const PouSymbol *from, const PouSymbol *to);
/// The same way, after the instance: `.base__.base__`
[[nodiscard]] std::string baseSuffix(const PouSymbol *from, const PouSymbol *to);
/// The same of blocks and of structures; empty for other types.
[[nodiscard]] std::string baseSuffix(const Type *from, const Type *to);
/// The way to the type id of an instance that has one: `base__.type__`
[[nodiscard]] std::string pathToTypeId(const PouSymbol *block);

/// The headers one file includes: those of complete types, and declarations of types that are only
/// pointed to.
class Includes;

/// Names of types and POUs, with the C++ types built from them. One per run.
class Names {
public:
  explicit Names(const Program &program);

  /// `user`, `Standard`: the innermost namespace and the folder.
  [[nodiscard]] std::string_view space(const Library *library) const;
  /// `Foo` of `::st::user::Foo`
  [[nodiscard]] std::string_view local(const Symbol *symbol);
  /// `::st::user::Foo`
  [[nodiscard]] std::string_view qualified(const Symbol *symbol);
  /// `GVL__`: what a list of variables is called in bodies and in the state.
  [[nodiscard]] std::string_view listName(const GlobalsSymbol *list);
  /// `st/user/Foo.h`
  [[nodiscard]] std::string_view header(const Symbol *symbol);

  /// `user/Foo.cpp`
  [[nodiscard]] std::string source(const Symbol *symbol);
  /// `st/user/Foo.inline.h`
  [[nodiscard]] std::string inlineHeader(const Symbol *symbol);
  /// What the type__ of its instances holds: never 0, different for all blocks of a program.
  [[nodiscard]] uint32_t typeId(const PouSymbol *block);

  /// `::stride::INT`, `::stride::Array<::st::user::Foo, 1, 3>`, `::st::user::Foo *`
  [[nodiscard]] std::string_view type(const Type *type);

  /// The symbol of a structure, enumeration or block; null for other types.
  [[nodiscard]] static const Symbol *symbolOf(const Type *type);
  /// The name of an elementary kind as ::stride and ::stride::Kind spell it.
  [[nodiscard]] static std::string_view elementary(TypeKind kind);

private:
  struct Entry {
    std::string local;
    std::string qualified;
    std::string header;
    std::string file; ///< `user/Foo`
    std::string list; ///< of a list of variables
  };
  const Entry &entry(const Symbol *symbol);

  const Program &program_;
  std::unordered_map<const PouSymbol *, uint32_t> typeIds_;
  std::unordered_map<const Library *, std::string> spaces_;
  std::unordered_map<const Symbol *, Entry> entries_;
  std::unordered_map<const Type *, std::string> types_;
  std::unordered_map<std::string, const Symbol *>
      taken_; ///< headers; tells apart synthesized types of one name
};

/// Collects what a generated file must include.
class Includes {
public:
  explicit Includes(Names &names) : names_(names) {}

  /// Values of the type are used.
  void complete(const Type *type);
  /// Pointers to the type are used.
  void pointed(const Type *type);
  /// The header of a POU, an enumeration, a global variable list …
  void symbol(const Symbol *symbol) {
    if (symbol != last_ && seen_.insert(symbol).second)
      headers_.push_back(symbol);
    last_ = symbol;
  }

  /// The header of a POU that is called, with its body where that is small; one that is not called
  /// often must be tiny.
  void called(const PouSymbol *pou, bool often);

  /// An assertion is made.
  void assertion() { needsAssertions_ = true; }

  void merge(const Includes &other);

  /// Includes and forward declarations, sorted; `own` is left out, and so are bodies where they are
  /// not wanted, and those of the library `beside`, which stand in the same translation unit.
  [[nodiscard]] std::string text(const Symbol *own, bool bodies = true,
                                 const Library *beside = nullptr) const;

private:
  Names &names_;
  bool needsOpenArray_ = false;
  bool needsAssertions_ = false;
  const Symbol *last_ = nullptr;
  std::unordered_set<const Symbol *> seen_;
  std::vector<const Symbol *> headers_;
  std::unordered_set<const Symbol *> bodies_;
  std::unordered_set<const Symbol *> declaredSet_;
  std::vector<const Symbol *> declared_;
};

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_CPP_NAMES_HPP
