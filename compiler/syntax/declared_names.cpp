// The names of a file by its tokens alone.
#include "compiler/source/identifier.hpp"
#include "compiler/syntax/conditions.hpp"
#include "compiler/syntax/scanner.hpp"

#include <algorithm>
#include <filesystem>
#include <initializer_list>

namespace stc {

namespace {

bool opensPou(uint16_t type) {
  switch (type) {
  case Tok::PROGRAM:
  case Tok::FUNCTION:
  case Tok::FUNCTION_BLOCK:
  case Tok::CLASS:
  case Tok::INTERFACE:
  case Tok::METHOD:
  case Tok::PROPERTY:
  case Tok::ACTION:
    return true;
  default:
    return false;
  }
}

} // namespace

const DeclaredNames::Entry *DeclaredNames::find(Kind kind, std::string_view name, FileId from) {
  std::call_once(isRead_, [this] {
    for (const FileId file : files_)
      read(sources_.file(file));
  });
  const auto [begin, end] = names_[static_cast<size_t>(kind)].equal_range(lowerCase(name));
  for (auto it = begin; it != end; ++it)
    if (it->second.local == 0 || it->second.local == from)
      return &it->second;
  return nullptr;
}

/// Reads the words of one file.
class DeclaredNames::Reader {
public:
  Reader(const SourceFile &file, DeclaredNames &into)
      : into_(into), file_(file.id()), scanner_(file, ignored_),
        list_(lowerCase(std::filesystem::path(file.name()).stem().string())),
        token_(scanner_.next()) {}

  void run() {
    while (token_.type != Token::kEnd) {
      collectAttributes();
      if (word() && token_.type != Token::kEnd)
        next();
    }
  }

private:
  void next() { token_ = scanner_.next(); }
  [[nodiscard]] std::string text() const { return lowerCase(scanner_.text(token_)); }
  [[nodiscard]] bool isNow(std::initializer_list<uint16_t> types) const {
    return std::find(types.begin(), types.end(), token_.type) != types.end();
  }

  void collectAttributes() {
    for (size_t i = 0; i < token_.triviaCount; ++i)
      if (const Trivia &one = scanner_.trivia()[token_.triviaBegin + i];
          one.kind == Trivia::Kind::Attribute)
        attributes_.push_back(lowerCase(one.name));
  }

  void add(Kind kind, const std::string &name, Entry entry) {
    into_.names_[static_cast<size_t>(kind)].emplace(name, std::move(entry));
  }

  /// Looks at one word; false: the next one is there already.
  bool word() {
    const uint16_t type = token_.type;
    if (section_ == 0 && opensPou(type)) {
      pou(type);
    } else if (section_ == 0 &&
               (type == Tok::TYPE || (type >= Tok::VAR && type <= Tok::VAR_INST))) {
      section_ = type;
      names_.clear();
    } else if (isNow({Tok::END_TYPE, Tok::END_VAR})) {
      section_ = 0;
      depth_ = 0;
      attributes_.clear();
    } else if (section_ == Tok::TYPE && isNow({Tok::STRUCT, Tok::UNION})) {
      ++depth_;
    } else if (section_ == Tok::TYPE && isNow({Tok::END_STRUCT, Tok::END_UNION})) {
      depth_ -= depth_ > 0;
      names_.clear();
    } else if (section_ != 0 && depth_ == 0 && type == Tok::IDENT) {
      names_.push_back(text());
    } else if (section_ != 0 && depth_ == 0 && type == Tok::COLON && !names_.empty()) {
      return declaration();
    } else if (type == Tok::SEMICOLON) {
      names_.clear();
      attributes_.clear();
    }
    return true;
  }

  void pou(uint16_t type) {
    do
      next();
    while (token_.type >= Tok::ABSTRACT && token_.type <= Tok::OVERRIDE);
    if (token_.type == Tok::IDENT) {
      std::string name = text();
      if (type == Tok::METHOD || type == Tok::PROPERTY || type == Tok::ACTION)
        name.insert(0, pou_ + ".");
      else
        pou_ = name;
      add(Kind::Pou, name, {std::move(attributes_), {}, {}, 0});
      if (type == Tok::FUNCTION_BLOCK || type == Tok::CLASS || type == Tok::INTERFACE)
        add(Kind::Type, name, {});
    }
    attributes_.clear();
  }

  /// What follows the colon, for all names before it.
  bool declaration() {
    Entry entry;
    entry.attributes = std::move(attributes_);
    attributes_.clear();
    bool inInit = false;
    next();
    const bool isStruct = isNow({Tok::STRUCT, Tok::UNION});
    while (!isStruct && !isNow({Tok::SEMICOLON, Tok::END_VAR, Tok::END_TYPE, Token::kEnd})) {
      if (token_.type == Tok::ASSIGN && !inInit)
        inInit = true;
      else
        (inInit ? entry.init : entry.type) += text();
      next();
    }
    if (section_ == Tok::TYPE) {
      add(Kind::Type, names_.front(), std::move(entry));
    } else {
      const bool isGlobal = section_ == Tok::VAR_GLOBAL;
      for (const std::string &name : names_) {
        Entry local = entry;
        local.local = isGlobal ? 0 : file_;
        add(Kind::Variable, name, std::move(local));
        add(Kind::Variable, (isGlobal ? list_ : pou_) + "." + name, entry);
      }
    }
    names_.clear();
    return !isStruct && !isNow({Tok::END_VAR, Tok::END_TYPE}); // else looked at next
  }

  DeclaredNames &into_;
  FileId file_;
  Diagnostics ignored_;
  Scanner scanner_;
  std::string list_; ///< the name of the file's list of global variables
  std::string pou_;
  uint16_t section_ = 0;                ///< TYPE or VAR…; 0: outside of them
  unsigned depth_ = 0;                  ///< of STRUCT within TYPE
  std::vector<std::string> attributes_; ///< of what is being declared
  std::vector<std::string> names_;      ///< before the colon
  Token token_;
};

void DeclaredNames::read(const SourceFile &file) { Reader(file, *this).run(); }

} // namespace stc
