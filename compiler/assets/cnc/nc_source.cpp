#include "compiler/assets/cnc/nc_source.hpp"

#include "runtime/numeric/nc/interpreter.hpp"
#include "runtime/numeric/nc/reader.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <memory>

namespace stc {

namespace {

namespace nc = stride::nc;
namespace cnc = stride::cnc;

/// So many sentences are carried out in loops.
constexpr size_t kMostNcSentences = 1000000;

struct ErrorText {
  nc::Error error;
  const char *message;
};

constexpr ErrorText kErrorTexts[] = {
    {nc::Error::UnexpectedEnd, "the line ends within a text, a variable or a comment"},
    {nc::Error::UnknownToken, "this character means nothing here"},
    {nc::Error::TextTooLong, "a text has 255 characters at most"},
    {nc::Error::BadNumber, "this is no number"},
    {nc::Error::TooFewArguments, "too few arguments"},
    {nc::Error::TooManyArguments, "too many arguments"},
    {nc::Error::ArgumentType, "a value of another type is needed"},
    {nc::Error::NoLocal, "there is no such local variable"},
    {nc::Error::OpenBracket, "this bracket is not closed"},
    {nc::Error::UnknownPrefix, "there is no such function"},
    {nc::Error::TermExpected, "a value is missing"},
    {nc::Error::SurplusTerms, "an operator is missing between two values"},
    {nc::Error::TooDeep, "too many brackets within each other"},
    {nc::Error::DuplicateParameter, "two parameters have this name"},
    {nc::Error::Incomplete, "the line is not complete"},
    {nc::Error::SymbolsFull, "the names of local variables do not fit"},
    {nc::Error::TooManyParameters, "a program has 21 parameters and local variables at most"},
    {nc::Error::UnknownWord, "there is no such word"},
    {nc::Error::MissingValue, "a word needs a value"},
    {nc::Error::BadType, "this word takes no value of this type"},
    {nc::Error::WrongToken, "something else is expected here"},
    {nc::Error::NameTooShort, "the name of a subprogram has 3 characters at least"},
    {nc::Error::NameTooLong, "a name has 80 characters at most"},
    {nc::Error::AddressExpected, "a word begins with a letter"},
    {nc::Error::NumberRange, "N is a whole number from 0 to 4294967295"},
    {nc::Error::NumberLiteral, "N takes a number only"},
    {nc::Error::ReservedWord, "this name means something else already"},
    {nc::Error::Conflict, "this local variable has been declared already"},
    {nc::Error::InitialType, "the initial value has another type"},
    {nc::Error::TooManyLocals, "a program has 21 parameters and local variables at most"},
    {nc::Error::DeclarationFirst, "SUBPROGRAM must come first"},
    {nc::Error::OneSubprogram, "a file has one subprogram"},
    {nc::Error::LateLet, "LET stands before all sentences"},
    {nc::Error::EndWithoutSubprogram, "END_SUBPROGRAM without SUBPROGRAM"},
    {nc::Error::TextAfterEnd, "only comments may follow END_SUBPROGRAM"},
    {nc::Error::EndMissing, "END_SUBPROGRAM is missing"},
    {nc::Error::UnknownJump, "no sentence has the number of this jump"},
    {nc::Error::WriteType, "this variable cannot take the value"},
    {nc::Error::StackOverflow, "this expression holds too many values at once"},
    {nc::Error::NotANumber, "the value is infinite or no number"},
    {nc::Error::DivisionByZero, "division by zero"},
    {nc::Error::StackTooSmall, "the local variables do not fit"},
    {nc::Error::Nesting, "14 calls within each other are possible"},
    {nc::Error::ReturnInMain, "only subprograms return"},
    {nc::Error::NotDeclaredHere, "the file does not hold this subprogram"},
    {nc::Error::QueueFull, "the sentence is too long"},
    {nc::Error::BufferTooSmall, "the line is too long"},
};

std::string describe(nc::Error error) {
  const auto *const found = std::find_if(std::begin(kErrorTexts), std::end(kErrorTexts),
                                         [&](const ErrorText &row) { return row.error == error; });
  return found != std::end(kErrorTexts) ? found->message : "this cannot be carried out";
}

bool isName(char c) { return nc::isLetter(c) || nc::isDigit(c) || c == '_'; }

/// A program, and the subprograms that it calls, as files.
class Expansion {
public:
  Expansion(const SourceFile &file, const NcLookup &lookup, CncValues &values,
            Diagnostics &diagnostics)
      : lookup_(lookup), values_(values), diagnostics_(diagnostics), files_{&file} {}

  std::optional<CncProgram> expand() {
    begin();
    const bool sub = enterOwn();
    for (size_t left = kMostNcSentences; !over_; --left) {
      if (left == 0) {
        report(Code::CncJump, program_.span, "the jumps of this program do not end");
        break;
      }
      if (!serve())
        break;
      read();
      if (sub) {
        if (reader_->ended)
          break;
        nc::emptySentences(*queue_);
        continue;
      }
      carry();
    }
    if (wrong_)
      return std::nullopt;
    program_.title = queue_->title;
    return std::move(program_);
  }

private:
  void begin() {
    const SourceFile &file = *files_.front();
    program_.name = std::filesystem::path(file.name()).stem().string();
    program_.span = {file.id(), 0, 0};
    const std::string_view text = file.text();
    program_.lines = static_cast<uint32_t>(std::count(text.begin(), text.end(), '\n')) +
                     (text.empty() || text.ends_with('\n') ? 0 : 1);
    parentheses_ = file.text().find("(*") == std::string_view::npos;
    nc::beginReading(*reader_, *queue_, false);
    nc::startInterpreter(*interpreter_);
    cnc::startDecoder(*decoder_, {});
    decoder_->softMotion3 = program_.settings.softMotion3 = true;
  }

  /// Whether the file is a subprogram, which is only read.
  bool enterOwn() {
    nc::ProgramLine line{};
    const std::string_view text = files_.front()->text();
    size_t at = 0;
    while (at < text.size()) {
      int64_t used = 0;
      const nc::LineEvent event =
          nc::readLine(line, parentheses_, reinterpret_cast<const uint8_t *>(text.data()) + at,
                       static_cast<int64_t>(text.size() - at), used);
      at += static_cast<size_t>(used);
      if (event == nc::LineEvent::Error)
        return false;
      const nc::Token first = nc::tokenAt(line, 0);
      if (event == nc::LineEvent::Line && first.kind != nc::TokenKind::End &&
          line.text[first.at] != '%') {
        if (!nc::isWordText(line, first, "SUBPROGRAM"))
          return false;
        const nc::Token name = nc::tokenAt(line, first.end);
        const int32_t length = name.kind == nc::TokenKind::Name ? name.length : 0;
        std::copy_n(line.text + name.start, length, queue_->name);
        queue_->name[length] = 0;
        nc::enterSubprogram(*reader_, *queue_);
        return true;
      }
      if (event == nc::LineEvent::Line)
        nc::nextLine(line);
    }
    return false;
  }

  /// What the queue asks for.
  bool serve() {
    if (queue_->request == nc::Request::Rewind) {
      at_ = static_cast<size_t>(nc::rewindProgram(*reader_, *queue_));
    } else if (queue_->request == nc::Request::Call) {
      std::string name = queue_->name;
      std::transform(name.begin(), name.end(), name.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
      });
      const SourceFile *const file = lookup_(name);
      if (file == nullptr) {
        report(Code::CncSentence, lineSpan(*files_.back(), carried_->line),
               fmt::format("there is no file {}{} for this subprogram", name, kCncSuffix));
        return false;
      }
      if (const int64_t at = nc::enterSubprogram(*reader_, *queue_); at >= 0)
        at_ = static_cast<size_t>(at);
      files_.push_back(file);
    } else if (queue_->request == nc::Request::Return) {
      files_.pop_back();
      at_ = static_cast<size_t>(nc::leaveSubprogram(*reader_, *queue_));
    }
    return true;
  }

  /// Variables have the type of their value; without one they count as numbers with the value 0.
  /// Each is listed before a line names it.
  void listVariables(std::string_view text) {
    for (size_t at = text.find('$'); at != std::string_view::npos; at = text.find('$', at)) {
      const size_t end = text.find_first_of("$\n", at + 1);
      if (end == std::string_view::npos)
        return;
      const std::string name(text.substr(at + 1, std::min<size_t>(end - at - 1, nc::kMostName)));
      at = end + 1;
      if (std::none_of(variables_.begin(), variables_.end(),
                       [&](const cnc::NamedVariable &v) { return name == v.name; })) {
        cnc::NamedVariable variable{};
        std::copy(name.begin(), name.end(), variable.name);
        variable.type = static_cast<int16_t>(cnc::VariableType::Lreal);
        if (const CncValue *const value = values_.find(name))
          setValue(variable, *value);
        variables_.push_back(variable);
      }
    }
  }

  /// Where the program may change it.
  void setValue(cnc::NamedVariable &variable, const CncValue &value) {
    constexpr size_t kPlace = nc::kTextVariableLength + 1;
    places_.push_back(std::make_unique<std::array<uint8_t, kPlace>>());
    uint8_t *const place = places_.back()->data();
    variable.address = place;
    if (value.number) {
      std::memcpy(place, &*value.number, sizeof *value.number);
    } else if (value.truth) {
      variable.type = nc::kBoolVariable;
      *place = *value.truth ? 1 : 0;
    } else {
      variable.type = nc::kTextVariable;
      value.text.copy(reinterpret_cast<char *>(place), kPlace - 1);
    }
  }

  void read() {
    const SourceFile &file = *files_.back();
    if (std::find(listed_.begin(), listed_.end(), &file) == listed_.end()) {
      listed_.push_back(&file);
      listVariables(file.text());
    }
    list_ = {static_cast<uint16_t>(std::min<size_t>(variables_.size(), 65535)), variables_.data()};
    queue_->variables = reinterpret_cast<uint8_t *>(&list_);
    const std::string_view text = file.text();
    int64_t used = 0;
    const nc::ReadState state =
        nc::readProgram(*reader_, *queue_, {&list_, parentheses_},
                        reinterpret_cast<const uint8_t *>(text.data()) + at_,
                        static_cast<int64_t>(text.size() - at_), true, used);
    at_ += static_cast<size_t>(used);
    // What was read before is carried out first; but the message may come at once.
    if (state == nc::ReadState::Wrong && !wrong_) {
      const Code code = reader_->error == nc::Error::NoVariable ? Code::CncVariable : Code::CncText;
      report(code, placeSpan(file, reader_->errorLine, reader_->errorColumn),
             describe(reader_->error));
    }
  }

  void carry() {
    const nc::Outcome outcome = nc::interpret(*interpreter_, *decoder_, *queue_, false, *carried_);
    over_ = over_ || outcome == nc::Outcome::Finished || outcome == nc::Outcome::Wrong;
    if (outcome == nc::Outcome::Wrong && carried_->error != nc::Error::None && !wrong_)
      report(Code::CncSentence, placeSpan(*files_.back(), carried_->line, carried_->column),
             describe(carried_->error));
    // A sentence that the decoder refuses is kept: its check says what is wrong.
    if (carried_->count > 0)
      keep();
  }

  void keep() {
    const Span span = lineSpan(*files_.back(), carried_->line);
    const size_t first = program_.words.size();
    for (int32_t i = 0; i < carried_->count; ++i) {
      CncWord word;
      word.word = carried_->words[i];
      word.span = span;
      const double value = word.word.value;
      if (word.word.letter == 'G' && (value == 20 || value == 36 || value == 37)) {
        program_.words.resize(first);
        return;
      }
      if (word.word.address != nullptr)
        word.variable = "variable";
      word.word.address = nullptr;
      program_.words.push_back(word);
    }
    CncWord end;
    end.word.letter = cnc::kEndOfSentence;
    end.word.integer = carried_->line + 1;
    end.span = span;
    program_.words.push_back(end);
  }

  static Span lineSpan(const SourceFile &file, int32_t line) {
    const uint32_t number = std::min(static_cast<uint32_t>(line) + 1, file.lineCount());
    const uint32_t begin = file.lineStart(number);
    const std::string_view text = file.line(number);
    const size_t blanks = std::min(text.find_first_not_of(" \t"), text.size());
    return {file.id(), begin + static_cast<uint32_t>(blanks),
            begin + static_cast<uint32_t>(text.size())};
  }

  /// A name or a character.
  static Span placeSpan(const SourceFile &file, int32_t line, int32_t column) {
    const uint32_t number = std::min(static_cast<uint32_t>(line) + 1, file.lineCount());
    const std::string_view text = file.line(number);
    const size_t at = std::min(static_cast<size_t>(column), text.size());
    size_t end = at;
    while (end < text.size() && isName(text[end]))
      ++end;
    const uint32_t begin = file.lineStart(number) + static_cast<uint32_t>(at);
    return {file.id(), begin,
            begin + static_cast<uint32_t>(std::max<size_t>(end - at, at < text.size() ? 1 : 0))};
  }

  void report(Code code, Span span, const std::string &message) {
    diagnostics_.report(code, span, message, "here");
    wrong_ = over_ = true;
  }

  const NcLookup &lookup_;
  CncValues &values_;
  std::vector<std::unique_ptr<std::array<uint8_t, nc::kTextVariableLength + 1>>> places_;
  Diagnostics &diagnostics_;
  std::vector<const SourceFile *> files_; ///< Of programs that call each other.
  std::vector<const SourceFile *> listed_;
  std::vector<cnc::NamedVariable> variables_;
  cnc::VariableList list_{};
  CncProgram program_;
  std::unique_ptr<nc::SentenceQueue> queue_ = std::make_unique<nc::SentenceQueue>();
  std::unique_ptr<nc::Reader> reader_ = std::make_unique<nc::Reader>();
  std::unique_ptr<nc::Interpreter> interpreter_ = std::make_unique<nc::Interpreter>();
  std::unique_ptr<cnc::Decoder> decoder_ = std::make_unique<cnc::Decoder>();
  std::unique_ptr<nc::Carried> carried_ = std::make_unique<nc::Carried>();
  size_t at_ = 0;
  bool parentheses_ = true;
  bool over_ = false;
  bool wrong_ = false;
};

} // namespace

bool needsNcLanguage(std::string_view text) {
  const bool other = text.find("(*") != std::string_view::npos;
  nc::ProgramLine line{};
  for (size_t at = 0; at < text.size();) {
    int64_t used = 0;
    const nc::LineEvent event =
        nc::readLine(line, true, reinterpret_cast<const uint8_t *>(text.data()) + at,
                     static_cast<int64_t>(text.size() - at), used);
    at += static_cast<size_t>(used);
    // A comment over several lines.
    if (event == nc::LineEvent::Error && other && line.error == nc::Error::UnexpectedEnd)
      return true;
    const std::string_view code(line.text, static_cast<size_t>(line.length));
    if (!code.starts_with('%') && code.find_first_of("{#'!?") != std::string_view::npos)
      return true;
    if (event == nc::LineEvent::Line)
      nc::nextLine(line);
  }
  return false;
}

std::optional<CncProgram> expandNc(const SourceFile &file, const NcLookup &lookup,
                                   CncValues &values, Diagnostics &diagnostics) {
  return Expansion(file, lookup, values, diagnostics).expand();
}

} // namespace stc
