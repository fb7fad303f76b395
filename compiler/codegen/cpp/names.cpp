#include "compiler/codegen/cpp/names.hpp"

#include "compiler/codegen/cpp/inlining.hpp"
#include "compiler/semantics/hierarchy.hpp"
#include "runtime/common/fnv.hpp"

#include <algorithm>
#include <array>
#include <tuple>

namespace stc::codegen {

namespace {

// C++ keywords, alternative tokens, contextual words that g++ warns about, and the macros of the
// headers that generated code includes. The words with upper-case letters are macros.
constexpr std::string_view kReserved =
    "alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t "
    "char16_t char32_t class compl concept const consteval constexpr constinit const_cast "
    "continue co_await co_return co_yield decltype default delete do double dynamic_cast "
    "else enum explicit export extern false float for friend goto if inline int long "
    "mutable namespace new noexcept not not_eq nullptr operator or or_eq private protected "
    "public register reinterpret_cast requires return short signed sizeof static "
    "static_assert static_cast struct switch template this thread_local throw true try "
    "typedef typeid typename union unsigned using virtual void volatile wchar_t while xor "
    "xor_eq typeof linux unix i386 offsetof "
    "NULL INT8_MIN INT16_MIN INT32_MIN INT64_MIN INT8_MAX INT16_MAX INT32_MAX INT64_MAX "
    "UINT8_MAX UINT16_MAX UINT32_MAX UINT64_MAX INT8_C INT16_C INT32_C INT64_C UINT8_C "
    "UINT16_C UINT32_C UINT64_C INTMAX_C UINTMAX_C INTPTR_MIN INTPTR_MAX UINTPTR_MAX "
    "INTMAX_MIN INTMAX_MAX UINTMAX_MAX PTRDIFF_MIN PTRDIFF_MAX SIZE_MAX WCHAR_MIN "
    "WCHAR_MAX WINT_MIN WINT_MAX SIG_ATOMIC_MIN SIG_ATOMIC_MAX INT_LEAST8_MIN "
    "INT_LEAST16_MIN INT_LEAST32_MIN INT_LEAST64_MIN INT_LEAST8_MAX INT_LEAST16_MAX "
    "INT_LEAST32_MAX INT_LEAST64_MAX UINT_LEAST8_MAX UINT_LEAST16_MAX UINT_LEAST32_MAX "
    "UINT_LEAST64_MAX INT_FAST8_MIN INT_FAST16_MIN INT_FAST32_MIN INT_FAST64_MIN "
    "INT_FAST8_MAX INT_FAST16_MAX INT_FAST32_MAX INT_FAST64_MAX UINT_FAST8_MAX "
    "UINT_FAST16_MAX UINT_FAST32_MAX UINT_FAST64_MAX ";

/// The reserved words, found by first character and length before anything is compared.
struct ReservedWords {
  std::array<uint32_t, 128> lengths{};
  std::unordered_set<std::string_view> words;
  ReservedWords() {
    for (size_t at = 0; at < kReserved.size();) {
      const std::string_view word = kReserved.substr(at, kReserved.find(' ', at) - at);
      words.insert(word);
      lengths[static_cast<unsigned char>(word.front())] |= 1U << word.size();
      at += word.size() + 1;
    }
  }
  [[nodiscard]] bool contains(std::string_view word) const {
    if (word.empty() || word.size() > 31)
      return false;
    const auto first = static_cast<unsigned char>(word.front());
    return first < 128 && (lengths[first] >> word.size() & 1U) != 0 && words.contains(word);
  }
};

/// A file's name as an identifier.
std::string identifier(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool good =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    out.push_back(good ? c : '_');
  }
  if (out.empty() || (out[0] >= '0' && out[0] <= '9'))
    out.insert(out.begin(), '_');
  return out;
}

/// A file's name of at most so many bytes, what the build appends to it (`.inline.h`, a number,
/// `.tmp`) left out: file systems know names of up to 255 bytes.
constexpr size_t kMaxFileName = 160;

/// A name for a file: the beginning of one that is too long, and the hash of the whole.
std::string shortened(const std::string &name) {
  if (name.size() <= kMaxFileName)
    return name;
  uint64_t hash = stride::common::Fnv1a<uint64_t>().add(name).value();
  std::string digits(16, '0');
  for (size_t i = digits.size(); i-- > 0; hash >>= 4U)
    digits[i] = "0123456789abcdef"[hash & 15U];
  return name.substr(0, kMaxFileName - digits.size() - 2) + "__" + digits;
}

bool isUpper(char c) { return c >= 'A' && c <= 'Z'; }

bool needsUnderscore(std::string_view name) {
  static const ReservedWords kWords;
  if (name.find("__") != std::string_view::npos)
    return true; // such names are ours
  if (name.size() >= 2 && name[0] == '_' && isUpper(name[1]))
    return true; // such names are the implementation's
  if (name.starts_with("STRIDE_"))
    return true;
  std::string_view bare = name;
  while (!bare.empty() && bare.back() == '_')
    bare.remove_suffix(1);
  return kWords.contains(bare);
}

} // namespace

void mangleTo(std::string &out, std::string_view name) {
  out.append(name);
  if (needsUnderscore(name))
    out.push_back('_');
}

std::string mangle(std::string_view name) {
  std::string out;
  mangleTo(out, name);
  return out;
}

std::string declared(std::string_view type, std::string_view mangled) {
  std::string out(type);
  if (out.back() != '*' && out.back() != '&')
    out += ' ';
  return out.append(mangled);
}

std::string fieldName(const VarSymbol *variable) {
  return mangle(variable->storage.empty() ? variable->name.text : variable->storage);
}

std::string methodName(const PouSymbol *method) {
  std::string name = mangle(method->name.text);
  if (method->property != nullptr)
    name += method->property->get == method ? "__get" : "__set";
  else if (method->name.id == method->owner->name.id) // else a constructor
    name += "__method";
  return name;
}

std::string pathToBase(const PouSymbol *from, const PouSymbol *to) {
  std::string path;
  for (const PouSymbol *p = from; p != nullptr && p != to; p = p->base)
    path += "base__.";
  return path;
}

std::string baseSuffix(const PouSymbol *from, const PouSymbol *to) {
  std::string suffix;
  for (const PouSymbol *p = from; p != nullptr && p != to; p = p->base)
    suffix += ".base__";
  return suffix;
}

std::string baseSuffix(const Type *from, const Type *to) {
  if (isInstance(from) && isInstance(to))
    return baseSuffix(typeAs<PouType>(from)->symbol, typeAs<PouType>(to)->symbol);
  std::string suffix;
  if (from->kind == TypeKind::Structure && to->kind == TypeKind::Structure)
    for (const auto *at = typeAs<StructType>(from); at != nullptr && at != to; at = at->base)
      suffix += ".base__";
  return suffix;
}

std::string pathToTypeId(const PouSymbol *block) {
  const PouSymbol *at = block;
  while (!carriesTypeId(at))
    at = at->base;
  return pathToBase(block, at) + "type__";
}

uint32_t Names::typeId(const PouSymbol *block) {
  if (typeIds_.empty()) {
    std::unordered_set<uint32_t> taken{0};
    for (const bool user : {false, true}) { // what a library is called does not depend on its user
      for (const auto &library : program_.libraries) {
        if (library->isUser != user)
          continue;
        for (const PouSymbol *p : library->pous) {
          if (!p->isBlock())
            continue;
          uint32_t id = stride::common::Fnv1a<uint32_t>()
                            .add(library->name)
                            .add(0xFF)
                            .add(p->name.id->lower)
                            .add(0xFF)
                            .value();
          while (!taken.insert(id).second)
            ++id;
          typeIds_.emplace(p, id);
        }
      }
    }
  }
  return typeIds_.at(block);
}

Names::Names(const Program &program) : program_(program) {
  const auto add = [&](const Library *library) {
    spaces_.emplace(library, library->isUser           ? "user"
                             : library->name == "user" ? "user_" // a library of one's own
                                                       : mangle(library->name));
  };
  for (const auto &library : program.libraries)
    add(library.get());
  if (program.user != nullptr)
    add(program.user);
}

std::string_view Names::space(const Library *library) const {
  const auto it = spaces_.find(library);
  return it == spaces_.end() ? std::string_view("user") : std::string_view(it->second);
}

const Names::Entry &Names::entry(const Symbol *symbol) {
  const auto [it, fresh] = entries_.try_emplace(symbol);
  Entry &entry = it->second;
  if (!fresh)
    return entry;
  if (symbol->kind == SymbolKind::Pou && static_cast<const PouSymbol *>(symbol)->isMethod()) {
    const auto *method = static_cast<const PouSymbol *>(symbol);
    const Entry &owner = this->entry(method->owner);
    entry.local = owner.local + "__" + methodName(method);
    entry.qualified = owner.qualified + "__" + methodName(method);
    entry.header = owner.header;
    entry.file = owner.file;
    return entry;
  }
  std::string file(symbol->name.text);
  if (symbol->kind == SymbolKind::Globals)
    file = identifier(file);
  const bool synthesized =
      symbol->kind == SymbolKind::Type && static_cast<const TypeSymbol *>(symbol)->decl == nullptr;
  entry.local = synthesized ? file : mangle(file);
  if (symbol->space != nullptr && symbol->kind != SymbolKind::Globals) {
    std::string prefix; // A__B__
    for (const char c : symbol->space->path)
      prefix += c == '.' ? std::string("__") : std::string(1, c);
    prefix += "__";
    file.insert(0, prefix);
    entry.local.insert(0, prefix);
  }
  if (symbol->kind == SymbolKind::Globals) {
    // A list is named after its file, and files may have any name.
    for (char &c : file)
      if (!((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9')))
        c = '_';
    if (file.empty() || (file.front() >= '0' && file.front() <= '9'))
      file.insert(0, "_");
    entry.local = file + "__globals__";
    entry.list = file + "__";
    file += "__globals__";
  }
  const std::string path = "st/" + std::string(space(symbol->library)) + "/" + shortened(file);
  std::string suffix;
  for (int n = 2; !taken_.emplace(path + suffix + ".h", symbol).second; ++n)
    suffix = "__" + std::to_string(n);
  entry.local += suffix;
  entry.list += suffix;
  entry.header = path + suffix + ".h";
  entry.file = std::string(space(symbol->library)) + "/" + shortened(file) + suffix;
  entry.qualified = "::st::" + std::string(space(symbol->library)) + "::" + entry.local;
  return entry;
}

std::string_view Names::local(const Symbol *symbol) { return entry(symbol).local; }
std::string_view Names::qualified(const Symbol *symbol) { return entry(symbol).qualified; }
std::string_view Names::listName(const GlobalsSymbol *list) { return entry(list).list; }
std::string_view Names::header(const Symbol *symbol) { return entry(symbol).header; }

const Symbol *Names::symbolOf(const Type *type) {
  switch (type->kind) {
  case TypeKind::Enumeration:
    return typeAs<EnumType>(type)->symbol;
  case TypeKind::Structure:
    return typeAs<StructType>(type)->symbol;
  case TypeKind::FunctionBlock:
  case TypeKind::Program:
    return typeAs<PouType>(type)->symbol;
  default:
    return nullptr;
  }
}

std::string_view Names::elementary(TypeKind kind) {
  static constexpr std::string_view kNames[] = {
      "None",  "None", "BOOL", "SINT",  "INT",   "DINT",   "LINT",    "USINT", "UINT",  "UDINT",
      "ULINT", "BYTE", "WORD", "DWORD", "LWORD", "REAL",   "LREAL",   "TIME",  "LTIME", "DATE",
      "LDATE", "TOD",  "LTOD", "DT",    "LDT",   "STRING", "WSTRING", "CHAR",  "WCHAR",
  };
  static_assert(std::size(kNames) == static_cast<size_t>(TypeKind::Wchar) + 1);
  if (kind == TypeKind::AnyInteger)
    return "DINT";
  if (kind == TypeKind::AnyReal)
    return "LREAL";
  return kind <= TypeKind::Wchar ? kNames[static_cast<size_t>(kind)] : std::string_view("None");
}

std::string Names::source(const Symbol *symbol) { return entry(symbol).file + ".cpp"; }

std::string Names::inlineHeader(const Symbol *symbol) {
  return "st/" + entry(symbol).file + ".inline.h";
}

std::string_view Names::type(const Type *type) {
  const auto found = types_.find(type);
  if (found != types_.end())
    return found->second;
  std::string text;
  switch (type->kind) {
  case TypeKind::None:
    text = "void";
    break;
  case TypeKind::Interface:
    text = "::stride::Interface";
    break;
  case TypeKind::String:
  case TypeKind::Wstring:
    text = type->kind == TypeKind::String ? "::stride::STRING<" : "::stride::WSTRING<";
    text += std::to_string(typeAs<StringType>(type)->length) + ">";
    break;
  case TypeKind::Subrange:
    text = this->type(typeAs<SubrangeType>(type)->base);
    break;
  case TypeKind::Array: {
    const auto *array = typeAs<ArrayType>(type);
    text = "::stride::Array<" + std::string(this->type(array->element)) + ", " +
           std::to_string(array->low) + ", " + std::to_string(array->high) + ">";
    break;
  }
  case TypeKind::OpenArray: {
    const auto *array = typeAs<OpenArrayType>(type);
    text = "::stride::OpenArray<" + std::string(this->type(array->element)) + ", " +
           std::to_string(array->dimensions) + ">";
    break;
  }
  case TypeKind::Pointer:
  case TypeKind::Reference:
    text = std::string(this->type(typeAs<PointerType>(type)->pointee));
    text += text.back() == '*' ? "*" : " *";
    break;
  default:
    if (const Symbol *symbol = symbolOf(type))
      text = qualified(symbol);
    else
      text = "::stride::" + std::string(elementary(type->kind));
    break;
  }
  return types_.emplace(type, std::move(text)).first->second;
}

void Includes::complete(const Type *type) {
  while (type->kind == TypeKind::Array || type->kind == TypeKind::Subrange)
    type = type->kind == TypeKind::Array ? typeAs<ArrayType>(type)->element
                                         : typeAs<SubrangeType>(type)->base;
  if (type->kind == TypeKind::OpenArray) {
    needsOpenArray_ = true;
    pointed(typeAs<OpenArrayType>(type)->element);
    return;
  }
  if (type->kind == TypeKind::Pointer || type->kind == TypeKind::Reference)
    pointed(typeAs<PointerType>(type)->pointee);
  else if (const Symbol *s = Names::symbolOf(type))
    symbol(s);
}

void Includes::pointed(const Type *type) {
  if (type->kind == TypeKind::OpenArray) {
    complete(type);
    return;
  }
  while (type->kind == TypeKind::Array || type->kind == TypeKind::Pointer ||
         type->kind == TypeKind::Reference)
    type = type->kind == TypeKind::Array ? typeAs<ArrayType>(type)->element
                                         : typeAs<PointerType>(type)->pointee;
  const Symbol *s = Names::symbolOf(type);
  if (s == nullptr)
    return;
  if (type->kind ==
      TypeKind::Enumeration) // an alias of a number: there is no way to declare it in advance
    symbol(s);
  else if (declaredSet_.insert(s).second)
    declared_.push_back(s);
}

void Includes::called(const PouSymbol *pou, bool often) {
  symbol(pou);
  if (isWorthInlining(pou, often))
    bodies_.insert(pou);
}

void Includes::merge(const Includes &other) {
  bodies_.insert(other.bodies_.begin(), other.bodies_.end());
  needsOpenArray_ = needsOpenArray_ || other.needsOpenArray_;
  needsAssertions_ = needsAssertions_ || other.needsAssertions_;
  for (const Symbol *s : other.headers_)
    symbol(s);
  for (const Symbol *s : other.declared_) {
    if (declaredSet_.insert(s).second)
      declared_.push_back(s);
  }
}

namespace {

bool isUnionSymbol(const Symbol *symbol) {
  if (symbol->kind != SymbolKind::Type)
    return false;
  const Type *type = static_cast<const TypeSymbol *>(symbol)->type;
  return type->kind == TypeKind::Structure && typeAs<StructType>(type)->isUnion;
}

} // namespace

std::string Includes::text(const Symbol *own, bool bodies, const Library *beside) const {
  std::vector<std::string> headers;
  for (const Symbol *s : headers_) {
    if (s != own)
      headers.emplace_back(bodies && s->library != beside && bodies_.contains(s)
                               ? names_.inlineHeader(s)
                               : names_.header(s));
  }
  std::sort(headers.begin(), headers.end());
  std::string out;
  if (needsOpenArray_)
    out += "#include \"runtime/iec/open_array.h\"\n";
  if (needsAssertions_)
    out += "#include \"runtime/iec/assert.h\"\n";
  for (const std::string &h : headers)
    out.append("#include \"").append(h).append("\"\n");
  std::vector<std::tuple<std::string_view, std::string_view, bool>> forward;
  for (const Symbol *s : declared_) {
    if (s != own && !seen_.contains(s))
      forward.emplace_back(names_.space(s->library), names_.local(s), isUnionSymbol(s));
  }
  std::sort(forward.begin(), forward.end());
  std::string_view open;
  for (const auto &[space, name, isUnion] : forward) {
    if (space != open) {
      out.append(open.empty() ? "\n" : "}\n").append("namespace st::").append(space).append(" {\n");
      open = space;
    }
    out.append(isUnion ? "union " : "struct ").append(name).append(";\n");
  }
  if (!open.empty())
    out.append("}\n");
  return out;
}

} // namespace stc::codegen
