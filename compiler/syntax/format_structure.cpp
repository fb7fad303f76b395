// Which tokens make a line of a formatted text, and what they open and close.
#include "compiler/source/identifier.hpp"
#include "compiler/syntax/format_layout.hpp"

#include "compiler/syntax/token_sets.hpp"

#include <algorithm>

namespace stc {

// -------------------------------------------------------------------------------------------------
// blocks

void FormatLayout::open(Kind kind, size_t to, LineKind line, bool indents) {
  const unsigned level = blocks_.back().content;
  const uint16_t keyword = type(at_);
  emit(to, level, line);
  blocks_.push_back({kind, keyword, level, level + (indents ? 1 : 0)});
  afterOpener_ = true;
}

unsigned FormatLayout::closeBlock(Kind kind) {
  for (size_t i = blocks_.size(); i-- > 1;) {
    if (blocks_[i].kind != kind)
      continue;
    const unsigned level = blocks_[i].level;
    blocks_.resize(i);
    return level;
  }
  return blocks_.back().content;
}

unsigned FormatLayout::closeBlock(uint16_t opener) {
  for (size_t i = blocks_.size(); i-- > 1;) {
    if (blocks_[i].type != opener)
      continue;
    const unsigned level = blocks_[i].level;
    blocks_.resize(i);
    return level;
  }
  return blocks_.back().content;
}

/// Before a declaration: statements that are open belong to a wrong text.
void FormatLayout::closeStatements() {
  while (blocks_.size() > 1 && blocks_.back().kind > Kind::Actions)
    blocks_.pop_back();
}

/// END_IF, END_VAR, END_PROGRAM …
bool FormatLayout::closer() {
  const uint16_t t = type(at_);
  const auto close = [&](uint16_t opener, bool separates) {
    closing_ = true;
    const unsigned level = closeBlock(opener);
    emit(withSemicolons(at_ + 1), level, LineKind::Statement);
    separate_ = separates;
    return true;
  };
  if (const uint16_t opener = openerOf(t); opener != 0)
    return close(opener, false);
  const Kind outer = blocks_.size() > 1 ? blocks_[blocks_.size() - 2].kind : Kind::File;
  const bool isGlobal = outer == Kind::File || outer == Kind::Space;
  switch (t) {
  case Tok::END_VAR: {
    closing_ = true;
    const unsigned level = closeBlock(Kind::Section);
    emit(at_ + 1, level, LineKind::Statement);
    separate_ = isGlobal;
    return true;
  }
  case Tok::END_STRUCT:
    return close(Tok::STRUCT, false);
  case Tok::END_UNION:
    return close(Tok::UNION, false);
  case Tok::END_TYPE:
    return close(Tok::TYPE, true);
  case Tok::END_PROGRAM:
    return close(Tok::PROGRAM, true);
  case Tok::END_FUNCTION:
    return close(Tok::FUNCTION, true);
  case Tok::END_FUNCTION_BLOCK:
    return close(Tok::FUNCTION_BLOCK, true);
  case Tok::END_CLASS:
    return close(Tok::CLASS, true);
  case Tok::END_INTERFACE:
    return close(Tok::INTERFACE, true);
  case Tok::END_NAMESPACE:
    return close(Tok::NAMESPACE, true);
  case Tok::END_CONFIGURATION:
    return close(Tok::CONFIGURATION, true);
  case Tok::END_RESOURCE:
    return close(Tok::RESOURCE, false);
  case Tok::END_METHOD:
    return close(Tok::METHOD, true);
  case Tok::END_PROPERTY:
    return close(Tok::PROPERTY, true);
  case Tok::END_ACTION:
    return close(Tok::ACTION, true);
  case Tok::END_ACTIONS:
    return close(Tok::ACTIONS, true);
  case Tok::END_GET:
    return close(Tok::GET, false);
  case Tok::END_SET:
    return close(Tok::SET, false);
  default:
    return false;
  }
}

// -------------------------------------------------------------------------------------------------
// lines

void FormatLayout::line() {
  const uint16_t t = type(at_);
  if (t == Tok::SEMICOLON && items_[at_].comments.empty() && at_ > 0 && !lines_.empty() &&
      lines_.back().comment.empty()) {
    const uint16_t before = type(at_ - 1);
    if (before == Tok::SEMICOLON || closesUnit(before) || openerOf(before) != 0) {
      lines_.back().text += ';';
      ++at_;
      return;
    }
  }
  if (blocks_.back().kind == Kind::Section || blocks_.back().kind == Kind::Structure ||
      blocks_.back().kind == Kind::Types || blocks_.back().kind == Kind::Enumeration) {
    if (insideSection())
      return;
  }
  if (closer() || configurationPart() || declaration())
    return;
  statement();
}

/// VAR, TYPE, STRUCT and enumerations; false when it is none of their lines, and closed.
bool FormatLayout::insideSection() {
  if (blocks_.back().kind == Kind::Enumeration) {
    enumerationLine();
    return true;
  }
  const uint16_t t = type(at_);
  if (t == Tok::END_VAR || t == Tok::END_STRUCT || t == Tok::END_UNION || t == Tok::END_TYPE)
    return closer();
  if (closesUnit(t) || startsSection(at_) || startsDeclaration(at_)) {
    while (blocks_.back().kind >= Kind::Section && blocks_.back().kind <= Kind::Enumeration)
      blocks_.pop_back();
    return false;
  }
  if (blocks_.back().kind == Kind::Types) {
    typeDeclaration();
    return true;
  }
  if (blocks_.back().type == Tok::VAR_ACCESS) {
    const size_t end = statementEnd(at_);
    const size_t last = end - 2;
    if (end >= 2 && last > at_ && isWordAt(last, "read_only"))
      items_[last].type = Tok::READ_ONLY;
    else if (end >= 2 && last > at_ && isWordAt(last, "read_write"))
      items_[last].type = Tok::READ_WRITE;
  }
  emit(statementEnd(at_), blocks_.back().content, LineKind::Declaration);
  return true;
}

/// A single type without a comment before its name stands on the line of TYPE.
bool FormatLayout::isOnlyType(size_t i) const {
  if (type(i) != Tok::IDENT && !isModifier(type(i)))
    return false;
  if (!items_[i].comments.empty())
    return false;
  while (type(i) != Tok::SEMICOLON && type(i) != Tok::STRUCT && type(i) != Tok::UNION &&
         !stopsStatement(i))
    ++i;
  if (type(i) == Tok::STRUCT || type(i) == Tok::UNION) {
    while (type(i) != Tok::END_STRUCT && type(i) != Tok::END_UNION && type(i) != Tok::END_TYPE &&
           !isEnd(type(i)))
      ++i;
    ++i;
  }
  while (type(i) == Tok::SEMICOLON)
    ++i;
  return type(i) == Tok::END_TYPE;
}

/// At the name, or at TYPE when the name stands on its line.
void FormatLayout::typeDeclaration() {
  const size_t end = statementEnd(at_);
  const unsigned level = blocks_.back().content;
  size_t colon = at_;
  while (colon < end && type(colon) != Tok::COLON)
    ++colon;
  const uint16_t first = type(colon + 1);
  if (colon >= end || (first != Tok::STRUCT && first != Tok::UNION && first != Tok::LPAREN)) {
    emit(end, level, LineKind::Head);
    return;
  }
  if (first == Tok::LPAREN) {
    LineRequest whole;
    whole.from = at_;
    whole.to = end;
    whole.level = level;
    whole.kind = LineKind::Head;
    const std::string flat = layLine(items_, whole, style_);
    const size_t used = size_t{level} * style_.indent + widthOf(flat);
    if (!hasComments(at_ + 1, end) && used <= style_.width &&
        flat.find('\n') == std::string::npos) {
      emit(end, level, LineKind::Head);
      return;
    }
  }
  emit(colon + 1, level, LineKind::Head);
  comments();
  if (first == Tok::LPAREN) {
    emit(at_ + 1, level, LineKind::Statement);
    blocks_.push_back({Kind::Enumeration, Tok::LPAREN, level, level + 1});
  } else {
    size_t head = at_ + 1;
    if (type(head) == Tok::EXTENDS)
      head = headRest(head, Tok::STRUCT);
    emit(withSemicolons(head), level, LineKind::Head);
    blocks_.push_back({Kind::Structure, first, level, level + 1});
  }
  afterOpener_ = true;
}

/// One enumerator a line.
void FormatLayout::enumerationLine() {
  const unsigned level = blocks_.back().level;
  if (type(at_) == Tok::RPAREN || type(at_) == Tok::SEMICOLON || stopsStatement(at_)) {
    blocks_.pop_back();
    if (type(at_) != Tok::RPAREN && type(at_) != Tok::SEMICOLON)
      return line();
    closing_ = true;
    emit(statementEnd(at_), level, LineKind::Head);
    return;
  }
  unsigned depth = 0;
  size_t end = at_;
  for (;; ++end) {
    if (end > at_ && stopsStatement(end))
      break;
    if (type(end) == Tok::LPAREN || type(end) == Tok::LBRACKET)
      ++depth;
    if (depth == 0 && (type(end) == Tok::RPAREN || type(end) == Tok::SEMICOLON))
      break;
    if (type(end) == Tok::RPAREN || type(end) == Tok::RBRACKET)
      depth -= depth > 0;
    if (type(end) == Tok::COMMA && depth == 0) {
      ++end;
      break;
    }
  }
  emit(end, level + 1, LineKind::Declaration);
}

bool FormatLayout::configurationPart() {
  if (blocks_.back().kind != Kind::Configuration)
    return false;
  if (isWordAt(at_, "resource") && type(at_ + 1) == Tok::IDENT) {
    items_[at_].type = Tok::RESOURCE;
    size_t end = at_ + 2;
    if (isWordAt(end, "on")) {
      items_[end].type = Tok::ON;
      end += type(end + 1) == Tok::IDENT ? 2 : 1;
    }
    open(Kind::Configuration, withSemicolons(end), LineKind::Configuration, true);
    return true;
  }
  const bool task = isWordAt(at_, "task") && type(at_ + 1) == Tok::IDENT;
  if (!task && type(at_) != Tok::PROGRAM)
    return false;
  size_t end = at_ + 1;
  while (type(end) != Tok::SEMICOLON && !closesUnit(type(end)) && !startsSection(end) &&
         !isMember(type(end)) && !(startsDeclaration(end) && type(end + 1) != Tok::COLON))
    ++end;
  end += type(end) == Tok::SEMICOLON;
  if (task)
    items_[at_].type = Tok::TASK;
  for (size_t i = at_ + 1; !task && i + 1 < end; ++i) {
    if (type(i + 1) != Tok::IDENT || type(i - 1) == Tok::COLON)
      continue;
    if (i == at_ + 1 && isWordAt(i, "retain"))
      items_[i].type = Tok::RETAIN;
    else if (i == at_ + 1 && isWordAt(i, "non_retain"))
      items_[i].type = Tok::NON_RETAIN;
    else if (type(i - 1) == Tok::IDENT && isWordAt(i, "with"))
      items_[i].type = Tok::WITH;
  }
  emit(end, blocks_.back().content, LineKind::Configuration);
  return true;
}

void FormatLayout::section() {
  const uint16_t t = type(at_);
  const bool globals = t == Tok::VAR_GLOBAL || t == Tok::VAR_CONFIG || t == Tok::VAR_ACCESS;
  if (!globals)
    closeStatements();
  size_t end = at_ + 1;
  while ((type(end) >= Tok::CONSTANT && type(end) <= Tok::NON_RETAIN) || isModifier(type(end)))
    ++end;
  open(Kind::Section, end, LineKind::Statement, true);
}

void FormatLayout::typeBlock() {
  closeStatements();
  const unsigned level = blocks_.back().content;
  if (isOnlyType(at_ + 1)) {
    blocks_.push_back({Kind::Types, Tok::TYPE, level, level});
    typeDeclaration();
  } else {
    open(Kind::Types, at_ + 1, LineKind::Statement, true);
  }
}

/// GET or SET of a property.
void FormatLayout::accessor() {
  if (blocks_.back().kind == Kind::Accessor)
    blocks_.pop_back();
  items_[at_].type = isWordAt(at_, "get") ? Tok::GET : Tok::SET;
  size_t end = at_ + 1;
  static constexpr std::string_view kAccess[] = {"public", "private", "protected", "internal"};
  const bool hasAccess = std::any_of(std::begin(kAccess), std::end(kAccess),
                                     [&](std::string_view word) { return isWordAt(end, word); });
  if (hasAccess && !continuesName(type(end + 1)))
    ++end;
  open(Kind::Accessor, end, LineKind::Head, false);
}

bool FormatLayout::declaration() {
  const uint16_t t = type(at_);
  if (startsSection(at_)) {
    section();
    return true;
  }
  const bool outer = startsDeclaration(at_);
  if (t == Tok::TYPE && outer) {
    typeBlock();
    return true;
  }
  if (t == Tok::USING) {
    emit(statementEnd(at_), blocks_.back().content, LineKind::Statement);
    return true;
  }
  if (t == Tok::NAMESPACE || t == Tok::CONFIGURATION) {
    closeStatements();
    open(t == Tok::NAMESPACE ? Kind::Space : Kind::Configuration, headEnd(at_), LineKind::Head,
         true);
    return true;
  }
  if (t == Tok::ACTIONS) {
    closeStatements();
    open(Kind::Actions, type(at_ + 1) == Tok::IDENT ? at_ + 2 : at_ + 1, LineKind::Head, false);
    return true;
  }
  if (t == Tok::EXTENDS || t == Tok::IMPLEMENTS ||
      (t == Tok::COLON && blocks_.back().kind == Kind::Pou)) {
    emit(headRest(at_, Tok::FUNCTION), blocks_.back().content, LineKind::Head);
    return true;
  }
  if (isMember(t) || outer) {
    closeStatements();
    open(t == Tok::PROPERTY ? Kind::Property : Kind::Pou, headEnd(at_), LineKind::Head, false);
    return true;
  }
  const Kind now = blocks_.back().kind;
  if ((now == Kind::Property || now == Kind::Accessor) && startsAccessor(at_)) {
    accessor();
    return true;
  }
  return false;
}

void FormatLayout::branchLabel() {
  if (blocks_.back().kind == Kind::Branch)
    blocks_.pop_back();
  const Block choice = blocks_.back();
  const size_t behind = labelEnd(at_);
  size_t end = behind;
  // A single statement stands on the line of its label.
  if (!stopsStatement(behind)) {
    const size_t stop = statementEnd(behind);
    blocks_.push_back({Kind::Branch, Tok::LABEL, choice.content, choice.content + 1});
    const bool isLast =
        type(stop) == Tok::ELSE || type(stop) == Tok::END_CASE || labelEnd(stop) != 0;
    const bool isLabel = labelEnd(behind) != 0;
    blocks_.pop_back();
    if (isLast && !isLabel && type(stop - 1) == Tok::SEMICOLON && !hasComments(at_ + 1, stop)) {
      LineRequest whole;
      whole.from = at_;
      whole.to = stop;
      whole.level = choice.content;
      whole.kind = LineKind::Label;
      const std::string text = layLine(items_, whole, style_);
      if (text.find('\n') == std::string::npos && size_t{choice.content} * style_.indent +
                                                          widthOf(text) +
                                                          widthOf(prefixAt(choice.content)) <
                                                      style_.width)
        end = stop;
    }
  }
  if (end == behind)
    while (type(end) == Tok::SEMICOLON && items_[end].comments.empty())
      ++end;
  emit(end, choice.content, LineKind::Label);
  blocks_.push_back({Kind::Branch, Tok::LABEL, choice.content, choice.content + 1});
  afterOpener_ = end == behind;
}

void FormatLayout::statement() {
  const uint16_t t = type(at_);
  const auto middle = [&](Kind kind, size_t end) {
    closing_ = true;
    size_t i = blocks_.size();
    while (i > 1 && blocks_[i - 1].kind != kind)
      --i;
    if (i > 1)
      blocks_.resize(i);
    const unsigned level = i > 1 ? blocks_.back().level : blocks_.back().content;
    emit(end, level, LineKind::Statement);
    afterOpener_ = true;
  };
  switch (t) {
  case Tok::IF:
    return open(Kind::Condition, through(at_ + 1, Tok::THEN), LineKind::Statement, true);
  case Tok::CASE:
    return open(Kind::Choice, through(at_ + 1, Tok::OF), LineKind::Statement, true);
  case Tok::FOR:
  case Tok::WHILE:
    return open(Kind::Loop, through(at_ + 1, Tok::DO), LineKind::Statement, true);
  case Tok::REPEAT:
    return open(Kind::Loop, at_ + 1, LineKind::Statement, true);
  case Tok::TRY:
    return open(Kind::Attempt, at_ + 1, LineKind::Statement, true);
  case Tok::ELSIF:
    return middle(Kind::Condition, through(at_ + 1, Tok::THEN));
  case Tok::ELSE: {
    // Of the innermost IF or CASE.
    size_t i = blocks_.size();
    while (i > 1 && blocks_[i - 1].kind != Kind::Condition && blocks_[i - 1].kind != Kind::Choice)
      --i;
    return middle(i > 1 ? blocks_[i - 1].kind : Kind::Condition, at_ + 1);
  }
  case Tok::UNTIL: {
    size_t end = at_ + 1;
    while (type(end) != Tok::SEMICOLON && !stopsStatement(end))
      ++end;
    return middle(Kind::Loop, withSemicolons(end));
  }
  case Tok::CATCH:
    return middle(Kind::Attempt,
                  type(at_ + 1) == Tok::LPAREN ? through(at_ + 1, Tok::RPAREN) : at_ + 1);
  case Tok::FINALLY:
    return middle(Kind::Attempt, at_ + 1);
  default:
    break;
  }
  if (labelEnd(at_) != 0)
    return branchLabel();
  if (t == Tok::IDENT && type(at_ + 1) == Tok::COLON) // where a JMP leads
    return emit(at_ + 2, blocks_.back().content, LineKind::Label);
  emit(statementEnd(at_), blocks_.back().content, LineKind::Statement);
}

} // namespace stc
