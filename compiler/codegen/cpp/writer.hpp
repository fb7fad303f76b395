#ifndef STRIDE_COMPILER_CODEGEN_CPP_WRITER_HPP
#define STRIDE_COMPILER_CODEGEN_CPP_WRITER_HPP
// Text of one generated file, and where each of its lines comes from.

#include "compiler/codegen/cpp/scoped.hpp"
#include "compiler/source/sources.hpp"

#include <charconv>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace stc::codegen {

/// A place in an ST file.
struct Place {
  uint32_t line = 0;
  uint32_t column = 0;
};

/// Appends to a text, with indentation and `#line` directives. A directive is written only where
/// the compiler's own count of lines would be wrong.
class Writer {
  enum class Form : uint8_t { Mapped, Unmapped, Gathered };

public:
  explicit Writer(const Sources &sources) : sources_(&sources) { text_.reserve(4096); }

  Writer &operator<<(std::string_view text) {
    text_.append(text);
    return *this;
  }
  /// Literals, whose lengths the compiler knows where it sees them.
  [[gnu::always_inline]] Writer &operator<<(const char *text) {
    return *this << std::string_view(text);
  }
  Writer &operator<<(const std::string &text) { return *this << std::string_view(text); }
  Writer &operator<<(char c) {
    text_.push_back(c);
    return *this;
  }
  template <std::integral T>
  requires(!std::same_as<T, char> && !std::same_as<T, bool>) Writer &operator<<(T value) {
    char digits[24];
    const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    text_.append(digits, end);
    return *this;
  }

  /// Begins a line of its own; end it with endLine().
  Writer &line() {
    if (form_ != Form::Gathered)
      text_.append(2 * indent_, ' ');
    return *this;
  }
  void endLine() {
    if (form_ == Form::Gathered) {
      text_.push_back(' ');
      return;
    }
    text_.push_back('\n');
    ++count_;
    ++believed_;
  }
  void blank() { endLine(); }
  void indent() { ++indent_; }
  void outdent() { --indent_; }

  /// What follows stands in the ST at `span`: the next line is counted as that line.
  void from(Span span);
  /// The next line is counted as the same line of the ST as the one before it.
  void sameLine();
  /// What follows belongs to the generated file `path` itself, not to the ST.
  void fromGenerated(std::string_view path);
  /// Appends the text of another writer, whose lines bring their own directives.
  void append(const Writer &other);

  /// The place of the span's begin.
  [[nodiscard]] Place place(Span span);

  /// What `write` appends, apart from the text (within the current line).
  template <class Write> [[nodiscard]] std::string aside(Write &&write) {
    std::string before = std::exchange(text_, std::exchange(spare_, {}));
    write();
    std::string result(text_);
    text_.clear();
    spare_ = std::exchange(text_, std::move(before));
    return result;
  }
  [[nodiscard]] bool empty() const { return text_.empty(); }
  [[nodiscard]] std::string take() { return std::move(text_); }

  /// Until the scope ends lines follow each other with a blank in between, on the current line.
  class Gathered {
  public:
    explicit Gathered(Writer &writer) : form_(writer.form_, Form::Gathered) {}

  private:
    Scoped<Form> form_;
  };
  /// No directives are written from now on: the lines are a header's own.
  void withoutDirectives() { form_ = Form::Unmapped; }

private:
  const Sources *sources_;
  std::string text_;
  std::string spare_; ///< empty, with room for what is written aside
  size_t indent_ = 0;
  uint32_t count_ = 1;    ///< number of the line being written
  uint32_t believed_ = 1; ///< what the C++ compiler takes it for
  Form form_ = Form::Mapped;
  FileId mapped_ = 0; ///< the file it takes it to be in; 0: the generated one
  // The place that was asked for last; the next one is usually near.
  FileId cachedFile_ = 0;
  uint32_t cachedBegin_ = 1; ///< of its line in the text
  uint32_t cachedEnd_ = 0;
  uint32_t cachedOffset_ = 0;
  Place cached_;
};

/// The text as a C++ string literal without its quotes.
std::string escaped(std::string_view text);

} // namespace stc::codegen

#endif // STRIDE_COMPILER_CODEGEN_CPP_WRITER_HPP
