#include "compiler/source/identifier.hpp"
#include "compiler/syntax/token.hpp"

#include <algorithm>
#include <array>

namespace stc {

namespace {

using Kind = Keyword::Kind;

struct Word {
  std::string_view upper;
  uint16_t type;
  Kind kind;
};

constexpr Word kWords[] = {
#define HARD(word)                                                                                 \
  { #word, Tok::word, Kind::Hard }
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
    {"AND", Tok::AND, Kind::Operation},
    {"OR", Tok::OR, Kind::Operation},
    {"XOR", Tok::XOR, Kind::Operation},
    {"MOD", Tok::MOD, Kind::Operation},
    {"__TRY", Tok::TRY, Kind::Hard},
    {"__CATCH", Tok::CATCH, Kind::Hard},
    {"__FINALLY", Tok::FINALLY, Kind::Hard},
    {"__ENDTRY", Tok::END_TRY, Kind::Hard},
    {"CONSTANT", Tok::CONSTANT, Kind::Qualifier},
    {"RETAIN", Tok::RETAIN, Kind::Qualifier},
    {"PERSISTENT", Tok::PERSISTENT, Kind::Qualifier},
    {"NON_RETAIN", Tok::NON_RETAIN, Kind::Qualifier},
    {"AT", Tok::AT, Kind::At},
    {"POINTER", Tok::POINTER, Kind::Pointer},
    {"REFERENCE", Tok::REFERENCE, Kind::Pointer},
    {"REF_TO", Tok::REF_TO, Kind::Pointer},
    {"AND_THEN", Tok::AND_THEN, Kind::Infix},
    {"OR_ELSE", Tok::OR_ELSE, Kind::Infix},
    {"CONTINUE", Tok::CONTINUE, Kind::Statement},
    {"EXTENDS", Tok::EXTENDS, Kind::Clause},
    {"IMPLEMENTS", Tok::IMPLEMENTS, Kind::Clause},
    {"ABSTRACT", Tok::ABSTRACT, Kind::Modifier},
    {"FINAL", Tok::FINAL, Kind::Modifier},
    {"PUBLIC", Tok::PUBLIC, Kind::Modifier},
    {"PRIVATE", Tok::PRIVATE, Kind::Modifier},
    {"PROTECTED", Tok::PROTECTED, Kind::Modifier},
    {"INTERNAL", Tok::INTERNAL, Kind::Modifier},
    {"OVERRIDE", Tok::OVERRIDE, Kind::Modifier},
    {"METHOD", Tok::METHOD, Kind::Construct},
    {"PROPERTY", Tok::PROPERTY, Kind::Construct},
    {"INTERFACE", Tok::INTERFACE, Kind::Construct},
    {"CLASS", Tok::CLASS, Kind::Construct},
    {"ACTION", Tok::ACTION, Kind::Construct},
    {"ACTIONS", Tok::ACTIONS, Kind::Construct},
    {"NAMESPACE", Tok::NAMESPACE, Kind::Construct},
    {"USING", Tok::USING, Kind::Construct},
    {"CONFIGURATION", Tok::CONFIGURATION, Kind::Construct},
    {"UNION", Tok::UNION, Kind::Construct},
    {"JMP", Tok::JMP, Kind::Construct},
    {"STEP", Tok::STEP, Kind::Construct},
    {"INITIAL_STEP", Tok::INITIAL_STEP, Kind::Construct},
    {"TRANSITION", Tok::TRANSITION, Kind::Construct},
    {"GET", Tok::GET, Kind::Local},
    {"SET", Tok::SET, Kind::Local},
    {"RESOURCE", Tok::RESOURCE, Kind::Local},
    {"ON", Tok::ON, Kind::Local},
    {"TASK", Tok::TASK, Kind::Local},
    {"WITH", Tok::WITH, Kind::Local},
    {"R_EDGE", Tok::R_EDGE, Kind::Local},
    {"F_EDGE", Tok::F_EDGE, Kind::Local},
    {"READ_ONLY", Tok::READ_ONLY, Kind::Local},
    {"READ_WRITE", Tok::READ_WRITE, Kind::Local},
    {"S", Tok::SET_ASSIGN, Kind::Assignment},
    {"R", Tok::RESET_ASSIGN, Kind::Assignment},
    {"REF", Tok::REF_ASSIGN, Kind::Assignment},
};

constexpr size_t kSlots = 512;

struct Table {
  struct Slot {
    uint32_t hash = 0;
    int16_t word = -1;
  };
  std::array<Slot, kSlots> slots{};

  constexpr Table() {
    for (size_t i = 0; i < std::size(kWords); ++i) {
      const uint32_t hash = hashIdent(kWords[i].upper);
      size_t at = (hash ^ (hash >> 15)) % kSlots;
      while (slots[at].word >= 0)
        at = (at + 1) % kSlots;
      slots[at] = {hash, static_cast<int16_t>(i)};
    }
  }
};

constexpr Table kTable;

/// Tokens that are no words, and those that look like words and signs.
struct Sign {
  uint16_t type;
  std::string_view text;
};

constexpr Sign kSigns[] = {
    {Tok::PLUS, "+"},          {Tok::MINUS, "-"},          {Tok::STAR, "*"},
    {Tok::SLASH, "/"},         {Tok::POWER, "**"},         {Tok::EQUAL, "="},
    {Tok::NOT_EQUAL, "<>"},    {Tok::LESS, "<"},           {Tok::LESS_EQUAL, "<="},
    {Tok::GREATER, ">"},       {Tok::GREATER_EQUAL, ">="}, {Tok::AMPERSAND, "&"},
    {Tok::ASSIGN, ":="},       {Tok::ARROW, "=>"},         {Tok::SET_ASSIGN, "S="},
    {Tok::RESET_ASSIGN, "R="}, {Tok::REF_ASSIGN, "REF="},  {Tok::SEMICOLON, ";"},
    {Tok::COLON, ":"},         {Tok::COMMA, ","},          {Tok::DOT, "."},
    {Tok::DOTDOT, ".."},       {Tok::LPAREN, "("},         {Tok::RPAREN, ")"},
    {Tok::LBRACKET, "["},      {Tok::RBRACKET, "]"},       {Tok::CARET, "^"},
};

} // namespace

bool isWord(std::string_view text, std::string_view lower) {
  return text.size() == lower.size() &&
         std::equal(text.begin(), text.end(), lower.begin(),
                    [](char a, char b) { return lowerCase(a) == b; });
}

Keyword findKeyword(std::string_view word, uint32_t hash) {
  for (size_t at = (hash ^ (hash >> 15)) % kSlots; kTable.slots[at].word >= 0;
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

std::string_view tokenSpelling(uint16_t type) {
  for (const Sign &sign : kSigns)
    if (sign.type == type)
      return sign.text;
  for (const Word &word : kWords)
    if (word.type == type)
      return word.upper;
  return {};
}

bool isKeywordType(uint16_t type) {
  return std::any_of(std::begin(kWords), std::end(kWords), [type](const Word &word) {
    return word.type == type && word.kind != Kind::Assignment;
  });
}

} // namespace stc
