#include "compiler/source/identifier.hpp"
#include "compiler/syntax/token.hpp"

#include <algorithm>
#include <array>

namespace stc {

namespace {

using Kind = Keyword::Kind;

struct Word {
  std::string_view upper;
  std::uint16_t type;
  Kind kind;
};

constexpr Word kWords[] = {
#define HARD(word)                                                                                 \
  { #word, Tok::word, Kind::hard }
    HARD(NOT),
    HARD(TRUE),
    HARD(FALSE),
    HARD(IF),
    HARD(THEN),
    HARD(ELSIF),
    HARD(ELSE),
    HARD(END_IF),
    HARD(CASE),
    HARD(OF),
    HARD(END_CASE),
    HARD(FOR),
    HARD(TO),
    HARD(BY),
    HARD(DO),
    HARD(END_FOR),
    HARD(WHILE),
    HARD(END_WHILE),
    HARD(REPEAT),
    HARD(UNTIL),
    HARD(END_REPEAT),
    HARD(EXIT),
    HARD(RETURN),
    HARD(PROGRAM),
    HARD(END_PROGRAM),
    HARD(FUNCTION),
    HARD(END_FUNCTION),
    HARD(FUNCTION_BLOCK),
    HARD(END_FUNCTION_BLOCK),
    HARD(TYPE),
    HARD(END_TYPE),
    HARD(STRUCT),
    HARD(END_STRUCT),
    HARD(VAR),
    HARD(VAR_INPUT),
    HARD(VAR_OUTPUT),
    HARD(VAR_IN_OUT),
    HARD(VAR_TEMP),
    HARD(VAR_STAT),
    HARD(VAR_EXTERNAL),
    HARD(VAR_GLOBAL),
    HARD(VAR_CONFIG),
    HARD(VAR_ACCESS),
    HARD(VAR_INST),
    HARD(END_VAR),
    HARD(ARRAY),
    HARD(STRING),
    HARD(WSTRING),
    HARD(END_METHOD),
    HARD(END_PROPERTY),
    HARD(END_INTERFACE),
    HARD(END_CLASS),
    HARD(END_ACTION),
    HARD(END_ACTIONS),
    HARD(END_GET),
    HARD(END_SET),
    HARD(END_NAMESPACE),
    HARD(END_CONFIGURATION),
    HARD(END_RESOURCE),
    HARD(END_UNION),
    HARD(END_STEP),
    HARD(END_TRANSITION),
#undef HARD
    {"AND", Tok::AND, Kind::operation},
    {"OR", Tok::OR, Kind::operation},
    {"XOR", Tok::XOR, Kind::operation},
    {"MOD", Tok::MOD, Kind::operation},
    {"__TRY", Tok::TRY, Kind::hard},
    {"__CATCH", Tok::CATCH, Kind::hard},
    {"__FINALLY", Tok::FINALLY, Kind::hard},
    {"__ENDTRY", Tok::END_TRY, Kind::hard},
    {"CONSTANT", Tok::CONSTANT, Kind::qualifier},
    {"RETAIN", Tok::RETAIN, Kind::qualifier},
    {"PERSISTENT", Tok::PERSISTENT, Kind::qualifier},
    {"NON_RETAIN", Tok::NON_RETAIN, Kind::qualifier},
    {"AT", Tok::AT, Kind::at},
    {"POINTER", Tok::POINTER, Kind::pointer},
    {"REFERENCE", Tok::REFERENCE, Kind::pointer},
    {"REF_TO", Tok::REF_TO, Kind::pointer},
    {"AND_THEN", Tok::AND_THEN, Kind::infix},
    {"OR_ELSE", Tok::OR_ELSE, Kind::infix},
    {"CONTINUE", Tok::CONTINUE, Kind::statement},
    {"EXTENDS", Tok::EXTENDS, Kind::clause},
    {"IMPLEMENTS", Tok::IMPLEMENTS, Kind::clause},
    {"ABSTRACT", Tok::ABSTRACT, Kind::modifier},
    {"FINAL", Tok::FINAL, Kind::modifier},
    {"PUBLIC", Tok::PUBLIC, Kind::modifier},
    {"PRIVATE", Tok::PRIVATE, Kind::modifier},
    {"PROTECTED", Tok::PROTECTED, Kind::modifier},
    {"INTERNAL", Tok::INTERNAL, Kind::modifier},
    {"OVERRIDE", Tok::OVERRIDE, Kind::modifier},
    {"METHOD", Tok::METHOD, Kind::construct},
    {"PROPERTY", Tok::PROPERTY, Kind::construct},
    {"INTERFACE", Tok::INTERFACE, Kind::construct},
    {"CLASS", Tok::CLASS, Kind::construct},
    {"ACTION", Tok::ACTION, Kind::construct},
    {"ACTIONS", Tok::ACTIONS, Kind::construct},
    {"NAMESPACE", Tok::NAMESPACE, Kind::construct},
    {"USING", Tok::USING, Kind::construct},
    {"CONFIGURATION", Tok::CONFIGURATION, Kind::construct},
    {"UNION", Tok::UNION, Kind::construct},
    {"JMP", Tok::JMP, Kind::construct},
    {"STEP", Tok::STEP, Kind::construct},
    {"INITIAL_STEP", Tok::INITIAL_STEP, Kind::construct},
    {"TRANSITION", Tok::TRANSITION, Kind::construct},
    {"GET", Tok::GET, Kind::local},
    {"SET", Tok::SET, Kind::local},
    {"RESOURCE", Tok::RESOURCE, Kind::local},
    {"ON", Tok::ON, Kind::local},
    {"TASK", Tok::TASK, Kind::local},
    {"WITH", Tok::WITH, Kind::local},
    {"READ_ONLY", Tok::READ_ONLY, Kind::local},
    {"READ_WRITE", Tok::READ_WRITE, Kind::local},
    {"S", Tok::SET_ASSIGN, Kind::assignment},
    {"R", Tok::RESET_ASSIGN, Kind::assignment},
    {"REF", Tok::REF_ASSIGN, Kind::assignment},
};

constexpr std::size_t kSlots = 512;

struct Table {
  struct Slot {
    std::uint32_t hash = 0;
    std::int16_t word = -1;
  };
  std::array<Slot, kSlots> slots{};

  constexpr Table() {
    for (std::size_t i = 0; i < std::size(kWords); ++i) {
      const std::uint32_t hash = hashIdent(kWords[i].upper);
      std::size_t at = (hash ^ (hash >> 15)) % kSlots;
      while (slots[at].word >= 0)
        at = (at + 1) % kSlots;
      slots[at] = {hash, static_cast<std::int16_t>(i)};
    }
  }
};

constexpr Table kTable;

} // namespace

bool isWord(std::string_view text, std::string_view lower) {
  return text.size() == lower.size() &&
         std::equal(text.begin(), text.end(), lower.begin(),
                    [](char a, char b) { return lowerCase(a) == b; });
}

Keyword findKeyword(std::string_view word, std::uint32_t hash) {
  for (std::size_t at = (hash ^ (hash >> 15)) % kSlots; kTable.slots[at].word >= 0;
       at = (at + 1) % kSlots) {
    if (kTable.slots[at].hash != hash)
      continue;
    const Word &entry = kWords[kTable.slots[at].word];
    if (word.size() == entry.upper.size() &&
        std::equal(word.begin(), word.end(), entry.upper.begin(),
                   [](char a, char b) { return lowerCase(a) == lowerCase(b); }))
      return {entry.kind, entry.type};
  }
  return {};
}

std::string_view tokenSpelling(std::uint16_t type) {
  switch (type) {
  case Tok::PLUS:
    return "+";
  case Tok::MINUS:
    return "-";
  case Tok::STAR:
    return "*";
  case Tok::SLASH:
    return "/";
  case Tok::POWER:
    return "**";
  case Tok::EQUAL:
    return "=";
  case Tok::NOT_EQUAL:
    return "<>";
  case Tok::LESS:
    return "<";
  case Tok::LESS_EQUAL:
    return "<=";
  case Tok::GREATER:
    return ">";
  case Tok::GREATER_EQUAL:
    return ">=";
  case Tok::AMPERSAND:
    return "&";
  case Tok::ASSIGN:
    return ":=";
  case Tok::ARROW:
    return "=>";
  case Tok::SET_ASSIGN:
    return "S=";
  case Tok::RESET_ASSIGN:
    return "R=";
  case Tok::REF_ASSIGN:
    return "REF=";
  case Tok::SEMICOLON:
    return ";";
  case Tok::COLON:
    return ":";
  case Tok::COMMA:
    return ",";
  case Tok::DOT:
    return ".";
  case Tok::DOTDOT:
    return "..";
  case Tok::LPAREN:
    return "(";
  case Tok::RPAREN:
    return ")";
  case Tok::LBRACKET:
    return "[";
  case Tok::RBRACKET:
    return "]";
  case Tok::CARET:
    return "^";
  default:
    break;
  }
  for (const Word &word : kWords)
    if (word.type == type)
      return word.upper;
  return {};
}

bool isKeywordType(std::uint16_t type) {
  return std::any_of(std::begin(kWords), std::end(kWords), [type](const Word &word) {
    return word.type == type && word.kind != Kind::assignment;
  });
}

} // namespace stc
