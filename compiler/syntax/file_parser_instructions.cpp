// Bodies that are instruction lists: where one begins, and its lines.
#include "compiler/syntax/file_parser.hpp"

#include "compiler/syntax/characters.hpp"
#include "compiler/syntax/instruction_list.hpp"
#include "compiler/syntax/token_sets.hpp"

namespace stc {

namespace {

/// After the blanks and comments from `at` on; not past the end of the line when `inLine`.
size_t blanksEnd(std::string_view text, size_t at, bool inLine) {
  while (at < text.size()) {
    const size_t comment = commentEnd(text, at);
    if (comment != at)
      at = comment;
    else if (classOf(text[at]) == kBlank && !(inLine && text[at] == '\n'))
      ++at;
    else
      break;
  }
  return at;
}

/// Whether an instruction stands there that is no statement of Structured Text.
bool instructionAt(std::string_view text, size_t at) {
  const auto wordEnd = [&](size_t from) {
    while (from < text.size() && isWordChar(text[from]))
      ++from;
    return from;
  };
  const size_t end = wordEnd(at);
  const InstructionOperator *op = findInstruction(text.substr(at, end - at));
  if (op == nullptr)
    return false;
  const size_t next = blanksEnd(text, end, op->most != 0);
  if (op->most == 0)
    return next >= text.size() ||
           (isLetter(text[next]) && text[blanksEnd(text, end, true)] == '\n');
  if (next >= text.size() || next == end)
    return false;
  const char first = text[next];
  if (first == '%' || first == '\'' || first == '"' || (first >= '0' && first <= '9'))
    return true;
  if ((first == '-' || first == '+') && op->operation == Operation::Load)
    return true;
  if (!isLetter(first))
    return false;
  // `s S= x;` and `add AND b` are none.
  const size_t after = wordEnd(next);
  if (after < text.size() && text[after] == '=')
    return false;
  if (op->operation != Operation::Jump)
    return findKeyword(text.substr(next, after - next), hashIdent(text.substr(next, after - next)))
               .kind != Keyword::Kind::Operation;
  const size_t semicolon = blanksEnd(text, after, false);
  return semicolon >= text.size() || text[semicolon] != ';';
}

} // namespace

bool isInstructionList(std::string_view body) {
  size_t at = blanksEnd(body, 0, false);
  size_t end = at;
  while (end < body.size() && isWordChar(body[end]))
    ++end;
  const size_t colon = blanksEnd(body, end, false);
  const std::string_view sign = body.substr(colon, 2);
  if (end != at && isLetter(body[at]) && sign.starts_with(':') && sign != ":=")
    at = blanksEnd(body, colon + 1, false); // after a label
  return instructionAt(body, at);
}

size_t FileParser::afterBlanks(size_t at, bool inLine) const {
  return blanksEnd(scanner_.text(), at, inLine);
}

/// Reads an instruction list; false: the body is none.
bool FileParser::instructionList(Content &out) {
  size_t at = now_.begin;
  if (now_.type == Tok::IDENT && ahead_.type == Tok::COLON)
    at = afterBlanks(ahead_.end, false);
  if (!instructionAt(scanner_.text(), at))
    return false;
  sawInstructions_ = true;
  std::vector<Instruction> list;
  while (!endsUnit() && !startsDeclaration() && !startsSection() && !isMember(now_.type) &&
         !isChart(now_.type) && !startsAccessor())
    readInstruction(list);
  std::vector<ast::Stmt *> statements;
  InstructionLowering(list, builder_.interner(), arena_, diagnostics_, out.variables)
      .run(statements);
  out.statements.insert(out.statements.end(), statements.begin(), statements.end());
  return true;
}

void FileParser::readInstruction(std::vector<Instruction> &list) {
  Instruction one;
  one.span = one.opSpan = span(now_);
  if (now_.type == Tok::RPAREN) {
    one.kind = Instruction::Kind::Close;
    advance();
  } else if (now_.type == Tok::IDENT && ahead_.type == Tok::COLON) {
    one.kind = Instruction::Kind::Label;
    one.label = builder_.name(now_);
    advance();
    advance();
  } else {
    std::vector<Token> line;
    const std::string word = readOperator(line);
    one.op = findInstruction(word);
    readOperands(line, one.op != nullptr && one.op->operation == Operation::Calculate);
    one.span = span(line.front()).to(span(line.back()));
    if (!understand(one, word, line))
      return;
  }
  list.push_back(std::move(one));
}

/// Takes the operator: one word, `&N`, or the path of a function. Gives its letters.
std::string FileParser::readOperator(std::vector<Token> &line) {
  std::string word(scanner_.text(now_));
  line.push_back(now_);
  const bool sign = now_.type == Tok::AMPERSAND;
  advance();
  if (sign && isNow("n") && now_.begin == line.back().end) {
    word += 'n';
    line.back().end = now_.end;
    advance();
  }
  while (now_.type == Tok::DOT && now_.begin == line.back().end && ahead_.type == Tok::IDENT) {
    for (int i = 0; i < 2; ++i) {
      word += scanner_.text(now_);
      line.push_back(now_);
      advance();
    }
  }
  return word;
}

/// Takes what belongs to the line: to its end, and on as long as a parenthesis is open that does
/// not wait for the instruction `)`.
void FileParser::readOperands(std::vector<Token> &line, bool nests) {
  unsigned depth = 0;
  size_t end = line.back().end;
  const std::string_view text = scanner_.text();
  const auto onNewLine = [&] {
    const size_t blank = afterBlanks(end, true);
    return blank >= text.size() || text[blank] == '\n';
  };
  bool opened = false;
  const size_t operatorTokens = line.size();
  while (!endsUnit()) {
    if (onNewLine()) {
      if (depth == 0 || (depth == 1 && opened))
        return;
    }
    if (now_.type == Tok::RPAREN && depth == 0)
      return;
    if (now_.type == Tok::LPAREN || now_.type == Tok::LBRACKET) {
      opened = opened || (nests && line.size() == operatorTokens);
      ++depth;
    } else if (now_.type == Tok::RPAREN || now_.type == Tok::RBRACKET) {
      --depth;
      opened = opened && depth != 0;
    }
    end = now_.end;
    line.push_back(now_);
    advance();
  }
}

/// What the operator's tokens and the others of the line say; false: nothing that could be read.
bool FileParser::understand(Instruction &one, const std::string &word, std::vector<Token> &line) {
  if (line.front().type != Tok::IDENT && one.op == nullptr) {
    diagnostics_
        .report(Code::UnknownInstruction, one.span, "this is not an instruction",
                "expected an operator")
        .help("a line of an instruction list is `operator operand`: `LD x`");
    return false;
  }
  if (hasWrongModifier(word)) {
    diagnostics_
        .report(Code::InstructionModifier, one.opSpan,
                "`" + word + "` is an operator with a modifier that it does not have", "not known")
        .help("LD, ST, AND, OR and XOR can have N; JMP, CAL and RET can have C or CN");
    return false;
  }
  size_t first = 1;
  if (one.op == nullptr)
    while (first + 1 < line.size() && line[first].type == Tok::DOT &&
           line[first].begin == line[first - 1].end)
      first += 2;
  one.opSpan = span(line.front()).to(span(line[first - 1]));
  std::vector<Token> rest(line.begin() + static_cast<ptrdiff_t>(first), line.end());
  if (one.op == nullptr) {
    const bool whole = !rest.empty() && rest.front().type == Tok::LPAREN;
    one.kind = whole ? Instruction::Kind::Value : Instruction::Kind::Function;
    if (whole) {
      one.operands.push_back(instructionOperand(line));
      return true;
    }
    line.resize(first);
    one.callee = instructionOperand(line);
  } else if (one.op->operation == Operation::Calculate && !rest.empty() &&
             rest.front().type == Tok::LPAREN) {
    int depth = 0;
    for (const Token &token : rest)
      depth += token.type == Tok::LPAREN ? 1 : token.type == Tok::RPAREN ? -1 : 0;
    one.opens = depth > 0;
    if (one.opens)
      rest.erase(rest.begin());
  }
  return takeOperands(one, rest);
}

/// Splits the operands at their commas.
bool FileParser::takeOperands(Instruction &one, const std::vector<Token> &rest) {
  if (one.op != nullptr && one.op->operation == Operation::Jump && rest.size() == 1 &&
      rest.front().type == Tok::IDENT) {
    one.label = builder_.name(rest.front());
    return true;
  }
  std::vector<std::vector<Token>> parts;
  int depth = 0;
  for (const Token &token : rest) {
    depth += token.type == Tok::LPAREN || token.type == Tok::LBRACKET   ? 1
             : token.type == Tok::RPAREN || token.type == Tok::RBRACKET ? -1
                                                                        : 0;
    if (parts.empty())
      parts.emplace_back();
    if (token.type == Tok::COMMA && depth == 0) {
      parts.emplace_back();
      continue;
    }
    if (!parts.back().empty() && depth == 0 && isOperandStart(token.type) &&
        isOperandEnd(parts.back().back().type))
      return wrongOperands(one, span(token), "a second operand without a comma");
    parts.back().push_back(token);
  }
  for (std::vector<Token> &part : parts) {
    if (part.empty())
      return wrongOperands(one, span(rest.back()), "an operand is missing at a comma");
    one.operands.push_back(instructionOperand(part));
  }
  if (one.op == nullptr || (one.opens && one.operands.size() <= 1))
    return true;
  if (one.op->operation == Operation::Jump)
    return wrongOperands(one, one.opSpan, "JMP wants the name of one label");
  if (one.operands.size() < one.op->least)
    return wrongOperands(one, one.opSpan, "an operand is missing");
  if (one.operands.size() > one.op->most)
    return wrongOperands(one, one.operands[one.op->most]->span,
                         one.op->most == 0 ? "the operator has no operand"
                                           : "the operator has one operand");
  return true;
}

bool FileParser::wrongOperands(const Instruction &one, Span where, const char *what) {
  diagnostics_.report(
      Code::InstructionOperands, where,
      "`" + std::string(file_.text().substr(one.opSpan.begin, one.opSpan.end - one.opSpan.begin)) +
          "` has not the operands that it needs",
      what);
  return false;
}

/// An operand is read as an expression of Structured Text.
ast::Expr *FileParser::instructionOperand(const std::vector<Token> &tokens) {
  unit_ = tokens;
  Token end = tokens.back();
  end.type = Tok::SEMICOLON;
  end.begin = end.end;
  end.triviaCount = 0;
  unit_.push_back(end);
  const Span whole = span(tokens.front()).to(span(tokens.back()));
  const size_t errors = diagnostics_.errorCount();
  std::vector<ast::Stmt *> statements;
  auto *unit = parseUnit(&Grammar::bodyUnit);
  if (unit != nullptr && !unit->children.empty())
    builder_.statements(static_cast<Grammar::StatementsContext *>(unit->children[0]), statements);
  if (statements.size() == 1 && statements.front()->kind == ast::StmtKind::Call)
    return ast::as<ast::CallStmt>(statements.front())->expr;
  if (diagnostics_.errorCount() == errors)
    diagnostics_.report(Code::UnexpectedToken, whole, "expected an operand", "this is a statement");
  auto *error = arena_.make<ast::Expr>();
  error->span = whole;
  return error;
}

} // namespace stc
