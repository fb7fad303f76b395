#include "compiler/syntax/file_parser.hpp"

#include "compiler/source/suggest.hpp"
#include "compiler/syntax/parser.hpp"
#include "compiler/syntax/token_sets.hpp"

#include <algorithm>

namespace stc {

namespace {

/// After that many errors the rest of a file is not looked at.
constexpr size_t kMaxErrors = 100;

/// A token and what becomes of it takes about 360 bytes while a unit is parsed.
constexpr size_t kMaxTokens = 4'000'000;

/// Where the first token is that is too much; the file's size when there is none.
size_t limitOf(const SourceFile &file) {
  if (file.text().size() <= kMaxTokens)
    return file.text().size(); // not even when each character is one
  Diagnostics ignored;
  Scanner scanner(file, ignored);
  for (size_t count = 0; count < kMaxTokens; ++count)
    if (scanner.next().type == Token::kEnd)
      return file.text().size();
  return scanner.next().begin;
}

} // namespace

FileParser::FileParser(const SourceFile &file, Interner &interner, Arena &arena,
                       Diagnostics &diagnostics, const ParseOptions *options)
    : file_(file), arena_(arena), diagnostics_(diagnostics), conditions_(options),
      scanner_(file, diagnostics, &conditions_), parser_(&stream_),
      builder_(scanner_, file.id(), stream_, interner, arena, diagnostics),
      report_(parser_, file.text(), file.id(), diagnostics) {
  unit_.reserve(3072);
  stream_.reset(unit_);
}

/// A project or an export of another tool.
static bool looksLikeXml(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF"))
    text.remove_prefix(3);
  const size_t begin = text.find_first_not_of(" \t\r\n");
  return begin != std::string_view::npos && text.substr(begin).starts_with("<?xml");
}

bool FileParser::refuses() {
  if (looksBinary(file_.text())) {
    diagnostics_.report(Code::BinaryFile, {}, "`" + file_.name() + "` is not a text file");
    return true;
  }
  if (looksLikeXml(file_.text())) {
    diagnostics_.report(Code::BinaryFile, {}, "`" + file_.name() + "` is XML")
        .help("export the program as text: only Structured Text is compiled");
    return true;
  }
  const size_t limit = limitOf(file_);
  if (limit >= file_.text().size())
    return false;
  const auto place = static_cast<uint32_t>(limit);
  diagnostics_
      .report(Code::FileTooLong, {file_.id(), place, place + 1},
              "the file has more than 4,000,000 words and signs")
      .help("make several files of it, or let the program read its table from a file");
  return true;
}

void FileParser::declaration() {
  switch (now_.type) {
  case Tok::SEMICOLON:
    return advance();
  case Tok::PROGRAM:
  case Tok::FUNCTION:
  case Tok::FUNCTION_BLOCK:
  case Tok::CLASS:
  case Tok::INTERFACE:
    return pou();
  case Tok::METHOD:
  case Tok::PROPERTY:
  case Tok::ACTION:
  case Tok::ACTIONS:
    return lateMember();
  case Tok::TYPE:
    return types();
  case Tok::VAR_GLOBAL:
  case Tok::VAR_CONFIG:
  case Tok::VAR_ACCESS:
    return globals();
  case Tok::NAMESPACE:
    return namespaceHead();
  case Tok::USING:
    usingDirective(usings_);
    usingsNow_ = arena_.copy(usings_);
    return;
  case Tok::CONFIGURATION:
    return configuration();
  default:
    return now_.type == Tok::END_NAMESPACE && !namespaces_.empty() ? namespaceEnd() : outside();
  }
}

void FileParser::giveMembers(OpenPou &open) {
  const auto inherit = [&](ast::Decl *member) {
    if (member == nullptr)
      return;
    member->space = open.node->space;
    if (member->usings.empty())
      member->usings = open.node->usings;
  };
  for (ast::PouDecl *one : open.methods)
    inherit(one);
  for (ast::PouDecl *one : open.actions)
    inherit(one);
  for (ast::PropertyDecl *one : open.properties) {
    inherit(one);
    inherit(one->get);
    inherit(one->set);
  }
  open.node->methods = arena_.copy(open.methods);
  open.node->actions = arena_.copy(open.actions);
  open.node->properties = arena_.copy(open.properties);
}

ast::File *FileParser::run() {
  auto *out = arena_.make<ast::File>();
  out->id = file_.id();
  if (refuses())
    return out;
  now_ = scanner_.next();
  ahead_ = scanner_.next();
  const size_t before = diagnostics_.errorCount();
  while (now_.type != Token::kEnd) {
    if (diagnostics_.errorCount() - before >= kMaxErrors) {
      diagnostics_.report(Code::UnexpectedToken, span(now_),
                          "too many errors; the rest of the file is not checked");
      break;
    }
    declaration();
  }
  for (const OpenNamespace &open : namespaces_)
    diagnostics_.report(Code::MissingEnd, open.head, "missing `END_NAMESPACE`",
                        "this is not closed");
  for (OpenPou &open : pous_)
    giveMembers(open);
  out->declarations = arena_.copy(declarations_);
  out->strayMembers = arena_.copy(strays_);
  out->hasInstructions = sawInstructions_;
  out->hasChart = sawChart_;
  return out;
}

// ---------------------------------------------------------------------------------------------------------
// tokens

void FileParser::advance() {
  for (size_t i = 0; i < now_.triviaCount; ++i) {
    const Trivia &trivia = scanner_.trivia()[now_.triviaBegin + i];
    if (trivia.kind == Trivia::Kind::External) {
      sawExternal_ = true;
      externalSpan_ = {file_.id(), trivia.begin, trivia.end};
    }
  }
  now_ = ahead_;
  ahead_ = scanner_.next();
}

void FileParser::take() {
  unit_.push_back(now_);
  advance();
}

bool FileParser::isNow(std::string_view lower) const {
  return now_.type == Tok::IDENT && isWord(scanner_.text(now_), lower);
}

bool FileParser::startsDeclaration() const {
  return stc::startsDeclaration(now_.type, ahead_.type);
}

bool FileParser::endsUnit() const { return closesUnit(now_.type); }

bool FileParser::startsSection() const { return stc::startsSection(now_.type, ahead_.type); }

/// GET or SET of a property.
bool FileParser::startsAccessor() const {
  return inProperty_ && (isNow("get") || isNow("set")) && !continuesName(ahead_.type);
}

void FileParser::finishUnit() {
  Token end;
  end.begin = now_.begin;
  end.end = now_.end;
  unit_.push_back(end);
  for (size_t i = 0; i < unit_.size(); ++i)
    unit_[i].index = static_cast<uint32_t>(i);
  stream_.reset(unit_);
}

/// What a declaration may begin with that is written `found`.
static void helpOutside(Diagnostic &d, Span where, std::string_view found) {
  static const std::vector<std::string_view> kOpeners = {
      "PROGRAM",   "FUNCTION",   "FUNCTION_BLOCK", "TYPE",          "INTERFACE", "METHOD",
      "NAMESPACE", "VAR_GLOBAL", "VAR_CONFIG",     "CONFIGURATION", "ACTION",    "PROPERTY"};
  const std::string_view meant = nearest(found, kOpeners);
  if (!meant.empty())
    d.suggest("write `" + std::string(meant) + "`", where, std::string(meant));
  else if (isWord(found, "struct") || isWord(found, "union"))
    d.help("a structure is declared `TYPE Name : STRUCT … END_STRUCT END_TYPE`");
  else
    d.help("statements stand inside PROGRAM, FUNCTION or FUNCTION_BLOCK");
}

/// Text between declarations.
void FileParser::outside() {
  const Token start = now_;
  const std::string found(scanner_.text(start).substr(0, 40));
  if (openerOf(start.type) != 0 || endsUnit() || start.type == Tok::END_TYPE ||
      start.type == Tok::END_VAR || start.type == Tok::END_STRUCT || start.type == Tok::END_UNION ||
      start.type == Tok::END_STEP || start.type == Tok::END_TRANSITION) {
    diagnostics_.report(Code::MismatchedEnd, span(start), "`" + found + "` closes nothing");
    advance();
    return;
  }
  if (startsSection())
    diagnostics_
        .report(Code::OutsideDeclaration, span(start),
                "`" + found + "` outside a program, function or function block")
        .help("global variables are declared in VAR_GLOBAL … END_VAR");
  else
    helpOutside(diagnostics_.report(Code::OutsideDeclaration, span(start),
                                    "expected a declaration, found `" + found + "`",
                                    "outside every declaration"),
                span(start), found);
  while (now_.type != Token::kEnd) {
    advance();
    if (startsDeclaration() || isMember(now_.type))
      return;
    if (endsUnit()) { // probably of what we skipped
      if (now_.type != Token::kEnd)
        advance();
      return;
    }
  }
}

void FileParser::add(ast::Decl *node) {
  node->space = spaceNow_;
  if (node->usings.empty())
    node->usings = usingsNow_;
  declarations_.push_back(node);
}

} // namespace stc
