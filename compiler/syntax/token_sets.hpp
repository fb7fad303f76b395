#ifndef STRIDE_COMPILER_SYNTAX_TOKEN_SETS_HPP
#define STRIDE_COMPILER_SYNTAX_TOKEN_SETS_HPP
// Sets of tokens, and other small questions about units. Internal to compiler/syntax: includes
// ANTLR.

#include "compiler/syntax/unit_parser.hpp"

#include <string>
#include <string_view>

namespace stc {

inline bool isEnd(uint16_t type) { return type == Token::kEnd; }

/// Closes or continues a block of statements.
inline bool isCloser(uint16_t type) {
  switch (type) {
  case Tok::LABEL:
  case Tok::ELSIF:
  case Tok::ELSE:
  case Tok::END_IF:
  case Tok::END_CASE:
  case Tok::END_FOR:
  case Tok::END_WHILE:
  case Tok::UNTIL:
  case Tok::END_REPEAT:
  case Tok::CATCH:
  case Tok::FINALLY:
  case Tok::END_TRY:
    return true;
  default:
    return false;
  }
}

inline bool startsBlock(uint16_t type) {
  switch (type) {
  case Tok::IF:
  case Tok::CASE:
  case Tok::FOR:
  case Tok::WHILE:
  case Tok::REPEAT:
  case Tok::TRY:
    return true;
  default:
    return false;
  }
}

inline bool isStatementKeyword(uint16_t type) {
  return startsBlock(type) || type == Tok::EXIT || type == Tok::RETURN || type == Tok::CONTINUE ||
         type == Tok::JMP || type == Tok::JUMP_LABEL;
}

inline bool startsOperand(uint16_t type) {
  switch (type) {
  case Tok::IDENT:
  case Tok::INTEGER:
  case Tok::REAL:
  case Tok::TRUE:
  case Tok::FALSE:
  case Tok::STRING_LITERAL:
  case Tok::WSTRING_LITERAL:
  case Tok::TIME_LITERAL:
  case Tok::TYPED_LITERAL:
  case Tok::ENUM_LITERAL:
  case Tok::DIRECT:
  case Tok::LPAREN:
  case Tok::LBRACKET:
  case Tok::NOT:
  case Tok::PLUS:
  case Tok::MINUS:
  case Tok::TYPE_ARGUMENT:
    return true;
  default:
    return false;
  }
}

inline bool startsStatement(uint16_t type) {
  return startsOperand(type) || isStatementKeyword(type) || type == Tok::SEMICOLON;
}

/// A type that is more than a name, and is no list of members.
inline bool startsWrittenType(uint16_t type) {
  switch (type) {
  case Tok::ARRAY:
  case Tok::STRING:
  case Tok::WSTRING:
  case Tok::POINTER:
  case Tok::REFERENCE:
  case Tok::REF_TO:
    return true;
  default:
    return false;
  }
}

inline bool startsType(uint16_t type) {
  return type == Tok::IDENT || type == Tok::STRUCT || startsWrittenType(type);
}

/// Keywords that can only be meant as names where an expression should stand.
inline bool canOnlyBeMeantAsName(uint16_t type) {
  switch (type) {
  case Tok::PROGRAM:
  case Tok::FUNCTION:
  case Tok::FUNCTION_BLOCK:
  case Tok::TYPE:
  case Tok::STRUCT:
  case Tok::ARRAY:
  case Tok::STRING:
  case Tok::WSTRING:
    return true;
  default:
    return false;
  }
}

/// Where a statement that could not be read certainly is over.
inline bool isStatementBoundary(uint16_t type) {
  return isEnd(type) || isCloser(type) || isStatementKeyword(type);
}

inline uint16_t closerOf(size_t rule) {
  switch (rule) {
  case Grammar::RuleIfStatement:
    return Tok::END_IF;
  case Grammar::RuleCaseStatement:
    return Tok::END_CASE;
  case Grammar::RuleForStatement:
    return Tok::END_FOR;
  case Grammar::RuleWhileStatement:
    return Tok::END_WHILE;
  case Grammar::RuleRepeatStatement:
    return Tok::END_REPEAT;
  case Grammar::RuleTryStatement:
    return Tok::END_TRY;
  default:
    return 0;
  }
}

/// An assignment whose right side was reached.
inline bool hasValue(const grammar::ContextBase *statement) {
  return !statement->children.empty() &&
         static_cast<const antlr4::RuleContext *>(statement->children.back())->getRuleIndex() ==
             Grammar::RuleExpression;
}

inline std::string ticked(std::string_view text) { return "`" + std::string(text) + "`"; }

inline bool isModifier(uint16_t type) { return type >= Tok::ABSTRACT && type <= Tok::OVERRIDE; }

/// The keyword that opens what `type` closes; 0 when it closes no block.
inline uint16_t openerOf(uint16_t type) {
  switch (type) {
  case Tok::END_IF:
    return Tok::IF;
  case Tok::END_CASE:
    return Tok::CASE;
  case Tok::END_FOR:
    return Tok::FOR;
  case Tok::END_WHILE:
    return Tok::WHILE;
  case Tok::END_REPEAT:
    return Tok::REPEAT;
  case Tok::END_TRY:
    return Tok::TRY;
  default:
    return 0;
  }
}

/// Opens something that belongs to a POU and may stand inside of it or after it.
inline bool isMember(uint16_t type) {
  return type == Tok::METHOD || type == Tok::PROPERTY || type == Tok::ACTION ||
         type == Tok::ACTIONS;
}

/// A sequential function chart.
inline bool isChart(uint16_t type) { return type >= Tok::STEP && type <= Tok::END_TRANSITION; }

/// Closes a declaration, other than TYPE and VAR.
inline bool closesUnit(uint16_t type) {
  switch (type) {
  case Token::kEnd:
  case Tok::END_PROGRAM:
  case Tok::END_FUNCTION:
  case Tok::END_FUNCTION_BLOCK:
  case Tok::END_METHOD:
  case Tok::END_PROPERTY:
  case Tok::END_GET:
  case Tok::END_SET:
  case Tok::END_ACTION:
  case Tok::END_ACTIONS:
  case Tok::END_INTERFACE:
  case Tok::END_CLASS:
  case Tok::END_NAMESPACE:
  case Tok::END_CONFIGURATION:
  case Tok::END_RESOURCE:
    return true;
  default:
    return false;
  }
}

/// Literals and names only.
inline bool isOperandStart(uint16_t type) {
  return type == Tok::IDENT || type == Tok::INTEGER || type == Tok::ENUM_LITERAL ||
         type == Tok::TYPED_LITERAL || type == Tok::STRING_LITERAL || type == Tok::TRUE ||
         type == Tok::FALSE;
}

inline bool isOperandEnd(uint16_t type) {
  return isOperandStart(type) || type == Tok::RPAREN || type == Tok::RBRACKET ||
         type == Tok::CARET || type == Tok::REAL || type == Tok::TIME_LITERAL;
}

/// Whether `now` begins a declaration; `ahead` is the token after it.
inline bool startsDeclaration(uint16_t now, uint16_t ahead) {
  switch (now) {
  case Tok::CLASS:
  case Tok::INTERFACE:
  case Tok::NAMESPACE:
  case Tok::USING:
  case Tok::CONFIGURATION:
    return true;
  case Tok::PROGRAM:
  case Tok::FUNCTION:
  case Tok::FUNCTION_BLOCK:
  case Tok::TYPE:
    return ahead == Tok::IDENT || isModifier(ahead);
  case Tok::VAR_GLOBAL:
  case Tok::VAR_CONFIG:
  case Tok::VAR_ACCESS:
    return ahead != Tok::COLON;
  default:
    return false;
  }
}

/// Whether `now` begins a section of variables.
inline bool startsSection(uint16_t now, uint16_t ahead) {
  return now >= Tok::VAR && now <= Tok::VAR_INST && ahead != Tok::COLON;
}

/// After the word GET or SET: it is a name, not an accessor of a property.
inline bool continuesName(uint16_t ahead) {
  switch (ahead) {
  case Tok::ASSIGN:
  case Tok::DOT:
  case Tok::LPAREN:
  case Tok::LBRACKET:
  case Tok::CARET:
  case Tok::COLON:
    return true;
  default:
    return false;
  }
}

} // namespace stc

#endif // STRIDE_COMPILER_SYNTAX_TOKEN_SETS_HPP
