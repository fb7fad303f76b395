// Programs of SoftMotion 3's language as texts for tests: read in pieces, carried out, with the
// files of their subprograms.
#ifndef STRIDE_TESTS_UNIT_NC_NC_RUN_HPP
#define STRIDE_TESTS_UNIT_NC_NC_RUN_HPP

#include "runtime/numeric/nc/interpreter.hpp"
#include "runtime/numeric/nc/reader.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace stride::nc::test {

struct Context {
  std::map<std::string, std::string> files; ///< Of subprograms, by names in lower case.
  std::vector<cnc::NamedVariable> variables;
  bool parentheses = false;
  bool suppress = false;
  size_t piece = 1000000; ///< Bytes at once.
  int sentences = 1;      ///< That are carried out between two pieces.
  int most = 20000;       ///< Sentences at most.
};

struct Ran {
  std::vector<cnc::PathObject> objects;
  Error error = Error::None;
  cnc::GCodeError sentence = cnc::GCodeError::None;
  int line = -1; ///< Of the error, from 0 on.
  int column = -1;
  bool finished = false;
  int carried = 0;
  std::string title;
  cnc::Decoder decoder{};
};

/// A variable of the list.
inline cnc::NamedVariable variable(const char *name, int16_t type, void *address) {
  cnc::NamedVariable made{};
  std::snprintf(made.name, sizeof made.name, "%s", name);
  made.type = type;
  made.address = static_cast<uint8_t *>(address);
  return made;
}

/// Who reads and carries out, alternately, as the blocks do.
class Run {
public:
  Run(const std::string &text, const Context &setup) : setup_(setup), texts_{text} {}

  Ran all() {
    cnc::VariableList list{static_cast<uint16_t>(setup_.variables.size()), setup_.variables.data()};
    queue_->variables = reinterpret_cast<uint8_t *>(&list);
    settings_ = {&list, setup_.parentheses};
    beginReading(*reader_, *queue_, false);
    startInterpreter(*interpreter_);
    cnc::startDecoder(out_.decoder, {});
    for (int idle = 0; idle < 3 && !over_;) {
      const int before = out_.carried;
      if (!serve())
        break;
      read();
      for (int i = 0; i < setup_.sentences && !over_; ++i)
        carry();
      const bool moved =
          out_.carried != before || at_ != oldAt_ || queue_->request != Request::None;
      idle = moved ? 0 : idle + 1;
      oldAt_ = at_;
      if (out_.carried > setup_.most)
        break;
    }
    out_.title = queue_->title;
    return out_;
  }

private:
  static std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](char c) {
      return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return text;
  }

  /// What the queue asks for.
  bool serve() {
    if (queue_->request == Request::Rewind) {
      at_ = static_cast<size_t>(rewindProgram(*reader_, *queue_));
    } else if (queue_->request == Request::Call) {
      const auto file = setup_.files.find(lower(queue_->name));
      if (file == setup_.files.end()) {
        out_.error = static_cast<Error>(2008);
        return false;
      }
      const int64_t at = enterSubprogram(*reader_, *queue_);
      if (at < 0) {
        out_.error = reader_->error;
        return false;
      }
      texts_.push_back(file->second);
      at_ = static_cast<size_t>(at);
    } else if (queue_->request == Request::Return) {
      texts_.pop_back();
      at_ = static_cast<size_t>(leaveSubprogram(*reader_, *queue_));
    }
    return true;
  }

  void read() {
    const std::string &text = texts_.back();
    const size_t piece = std::min(setup_.piece, text.size() - at_);
    int64_t used = 0;
    const ReadState state = readProgram(
        *reader_, *queue_, settings_, reinterpret_cast<const uint8_t *>(text.data()) + at_,
        static_cast<int64_t>(piece), at_ + piece == text.size(), used);
    at_ += static_cast<size_t>(used);
    if (state == ReadState::Wrong) {
      out_.line = reader_->errorLine;
      out_.column = reader_->errorColumn;
    }
  }

  void carry() {
    const Outcome outcome =
        interpret(*interpreter_, out_.decoder, *queue_, setup_.suppress, *carried_);
    const cnc::Decoded &decoded = carried_->decoded;
    out_.objects.insert(out_.objects.end(), decoded.objects, decoded.objects + decoded.count);
    over_ = outcome == Outcome::Finished || outcome == Outcome::Wrong;
    out_.finished = outcome == Outcome::Finished;
    out_.carried += outcome == Outcome::Carried ? 1 : 0;
    if (outcome != Outcome::Wrong)
      return;
    out_.error = carried_->error;
    out_.sentence = decoded.error;
    if (queue_->error == Error::None || carried_->error != queue_->error) {
      out_.line = carried_->line;
      out_.column = carried_->column;
    }
  }

  Context setup_;
  std::vector<std::string> texts_;
  ReadSettings settings_{};
  std::unique_ptr<SentenceQueue> queue_ = std::make_unique<SentenceQueue>();
  std::unique_ptr<Reader> reader_ = std::make_unique<Reader>();
  std::unique_ptr<Interpreter> interpreter_ = std::make_unique<Interpreter>();
  std::unique_ptr<Carried> carried_ = std::make_unique<Carried>();
  Ran out_;
  size_t at_ = 0;
  size_t oldAt_ = 1;
  bool over_ = false;
};

inline Ran runText(const std::string &text, const Context &setup = {}) {
  return Run(text, setup).all();
}

/// The X of the only line of `G1 X <expression>`.
inline double valueOfText(const std::string &expression, const Context &setup = {}) {
  const Ran ran = runText("N10 G1 X " + expression + " Y1 F10\n", setup);
  if (!ran.finished || ran.objects.size() != 1)
    return __builtin_nan("");
  return ran.objects[0].end.coordinate[cnc::kAxisX];
}

} // namespace stride::nc::test

#endif // STRIDE_TESTS_UNIT_NC_NC_RUN_HPP
