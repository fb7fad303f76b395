// The names of a file by its tokens alone.
#include "compiler/source/identifier.hpp"
#include "compiler/syntax/conditions.hpp"
#include "compiler/syntax/scanner.hpp"

#include <filesystem>

namespace stc {

namespace {

bool opensPou(std::uint16_t type) {
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
  if (!isRead_) {
    isRead_ = true;
    for (const FileId file : files_)
      read(sources_.file(file));
  }
  const auto [begin, end] = names_[static_cast<std::size_t>(kind)].equal_range(lowerCase(name));
  for (auto it = begin; it != end; ++it)
    if (it->second.local == 0 || it->second.local == from)
      return &it->second;
  return nullptr;
}

void DeclaredNames::read(const SourceFile &file) {
  Diagnostics ignored;
  Scanner scanner(file, ignored);
  const std::string list = lowerCase(std::filesystem::path(file.name()).stem().string());
  std::string pou;
  std::uint16_t section = 0;           // TYPE or VAR…; 0: outside of them
  unsigned depth = 0;                  // of STRUCT within TYPE
  std::vector<std::string> attributes; // of what is being declared
  std::vector<std::string> names;      // in front of the colon
  Token token = scanner.next();
  const auto collect = [&] {
    for (std::size_t i = 0; i < token.triviaCount; ++i)
      if (const Trivia &one = scanner.trivia()[token.triviaBegin + i];
          one.kind == Trivia::Kind::attribute)
        attributes.push_back(lowerCase(one.name));
  };
  const auto add = [&](Kind kind, const std::string &name, Entry entry) {
    names_[static_cast<std::size_t>(kind)].emplace(name, std::move(entry));
  };
  while (token.type != Token::kEnd) {
    collect();
    const std::uint16_t type = token.type;
    if (section == 0 && opensPou(type)) {
      do
        token = scanner.next();
      while (token.type >= Tok::ABSTRACT && token.type <= Tok::OVERRIDE);
      if (token.type == Tok::IDENT) {
        std::string name = lowerCase(scanner.text(token));
        if (type == Tok::METHOD || type == Tok::PROPERTY || type == Tok::ACTION)
          name.insert(0, pou + ".");
        else
          pou = name;
        add(Kind::pou, name, {std::move(attributes), {}, {}, 0});
        if (type == Tok::FUNCTION_BLOCK || type == Tok::CLASS || type == Tok::INTERFACE)
          add(Kind::type, name, {});
      }
      attributes.clear();
    } else if (section == 0 && (type == Tok::TYPE || (type >= Tok::VAR && type <= Tok::VAR_INST))) {
      section = type;
      names.clear();
    } else if (type == Tok::END_TYPE || type == Tok::END_VAR) {
      section = 0;
      depth = 0;
      attributes.clear();
    } else if (section == Tok::TYPE && (type == Tok::STRUCT || type == Tok::UNION)) {
      ++depth;
    } else if (section == Tok::TYPE && (type == Tok::END_STRUCT || type == Tok::END_UNION)) {
      depth -= depth > 0;
      names.clear();
    } else if (section != 0 && depth == 0 && type == Tok::IDENT) {
      names.push_back(lowerCase(scanner.text(token)));
    } else if (section != 0 && depth == 0 && type == Tok::COLON && !names.empty()) {
      Entry entry;
      entry.attributes = std::move(attributes);
      attributes.clear();
      bool inInit = false;
      token = scanner.next();
      const bool isStruct = token.type == Tok::STRUCT || token.type == Tok::UNION;
      while (!isStruct && token.type != Tok::SEMICOLON && token.type != Tok::END_VAR &&
             token.type != Tok::END_TYPE && token.type != Token::kEnd) {
        if (token.type == Tok::ASSIGN && !inInit)
          inInit = true;
        else
          (inInit ? entry.init : entry.type) += lowerCase(scanner.text(token));
        token = scanner.next();
      }
      if (section == Tok::TYPE) {
        add(Kind::type, names.front(), std::move(entry));
      } else {
        for (const std::string &name : names) {
          Entry local = entry;
          local.local = section == Tok::VAR_GLOBAL ? 0 : file.id();
          add(Kind::variable, name, std::move(local));
          add(Kind::variable, (section == Tok::VAR_GLOBAL ? list : pou) + "." + name, entry);
        }
      }
      names.clear();
      if (isStruct || token.type == Tok::END_VAR || token.type == Tok::END_TYPE)
        continue; // looked at above
    } else if (type == Tok::SEMICOLON) {
      names.clear();
      attributes.clear();
    }
    if (token.type != Token::kEnd)
      token = scanner.next();
  }
}

} // namespace stc
