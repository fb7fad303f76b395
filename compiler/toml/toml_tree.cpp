#include "compiler/toml/toml_tree.hpp"

#include "compiler/syntax/st_text.hpp"

#include <algorithm>

#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
// toml++ asserts that a key begins like one, or with NDEBUG and clang has the compiler assume it,
// and reports a few lines later that it does not: it is to report it.
#define TOML_ASSERT(expr) static_assert(true)
#pragma push_macro("NDEBUG")
#undef NDEBUG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#include <toml++/toml.h>
#pragma GCC diagnostic pop
#pragma pop_macro("NDEBUG")

namespace stc {

namespace {

// Converts toml++'s lines and columns (code points) to byte offsets.
class Reader {
public:
  explicit Reader(const SourceFile &file) : file_(file), text_(file.text()) {
    lineStarts_.push_back(0);
    for (size_t i = 0; i < text_.size(); ++i)
      if (text_[i] == '\n')
        lineStarts_.push_back(static_cast<uint32_t>(i + 1));
  }

  uint32_t offset(toml::source_position position) const {
    const size_t line = position.line > 0 ? position.line - 1 : 0;
    if (line >= lineStarts_.size())
      return static_cast<uint32_t>(text_.size());
    size_t at = lineStarts_[line];
    for (uint32_t column = 1; column < position.column && at < text_.size(); ++column) {
      ++at;
      while (at < text_.size() && (static_cast<unsigned char>(text_[at]) & 0xC0) == 0x80)
        ++at;
    }
    return static_cast<uint32_t>(std::min(at, text_.size()));
  }

  Span span(const toml::source_region &region) const {
    return {file_.id(), offset(region.begin), std::max(offset(region.begin), offset(region.end))};
  }

  // A scalar ends before the blanks and the comment that toml++ may count in.
  Span scalarSpan(const toml::source_region &region) const {
    Span result = span(region);
    while (result.end > result.begin + 1 &&
           std::string_view(" \t\r\n,]}").find(text_[result.end - 1]) != std::string_view::npos)
      --result.end;
    return result;
  }

  TomlNode node(const toml::node &from) const {
    TomlNode to;
    to.span = scalarSpan(from.source());
    if (const toml::table *table = from.as_table()) {
      to.kind = TomlKind::Table;
      to.span = span(from.source());
      for (const auto &[key, value] : *table) {
        TomlNode child = node(value);
        child.key = key.str();
        child.keySpan = span(key.source());
        if (child.kind == TomlKind::Table && !value.as_table()->is_inline())
          child.span = child.keySpan;
        to.children.push_back(std::move(child));
      }
      // toml++ sorts by name; messages and synthetic declarations follow the text.
      std::stable_sort(
          to.children.begin(), to.children.end(),
          [](const TomlNode &a, const TomlNode &b) { return a.keySpan.begin < b.keySpan.begin; });
    } else if (const toml::array *array = from.as_array()) {
      to.kind = TomlKind::Array;
      to.span = span(from.source());
      to.arrayOfTables = !array->empty();
      for (const toml::node &value : *array) {
        TomlNode child = node(value);
        child.keySpan = child.span;
        if (const toml::table *table = value.as_table()) {
          if (!table->is_inline())
            child.span = child.keySpan = headerKey(child.span);
        } else {
          to.arrayOfTables = false;
        }
        to.children.push_back(std::move(child));
      }
    } else if (const auto *string = from.as_string()) {
      to.kind = TomlKind::String;
      to.text = string->get();
    } else if (const auto *integer = from.as_integer()) {
      to.kind = TomlKind::Integer;
      to.integer = integer->get();
      to.floating = static_cast<double>(integer->get());
    } else if (const auto *floating = from.as_floating_point()) {
      to.kind = TomlKind::Floating;
      to.floating = floating->get();
    } else if (const auto *boolean = from.as_boolean()) {
      to.kind = TomlKind::Boolean;
      to.boolean = boolean->get();
    }
    return to;
  }

private:
  // The last key of the header `[[a.b.c]]` that the span begins at: `c`.
  Span headerKey(Span header) const {
    uint32_t begin = header.begin;
    while (begin < text_.size() &&
           (text_[begin] == '[' || text_[begin] == ' ' || text_[begin] == '\t'))
      ++begin;
    uint32_t end = begin;
    uint32_t key = begin;
    while (end < text_.size() && text_[end] != ']' && text_[end] != '\n') {
      if (text_[end] == '.')
        key = end + 1;
      ++end;
    }
    while (key < end && (text_[key] == ' ' || text_[key] == '\t'))
      ++key;
    while (end > key && (text_[end - 1] == ' ' || text_[end - 1] == '\t'))
      --end;
    return {file_.id(), key, end};
  }

  const SourceFile &file_;
  std::string_view text_;
  std::vector<uint32_t> lineStarts_;
};

bool isAlnum(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// `16#1000` is 16 and a comment in TOML: says so at the first such number. False: there is one.
bool noBases(const TomlNode &node, const SourceFile &file, Diagnostics &diagnostics) {
  const std::string_view text = file.text();
  uint32_t end = node.span.end;
  if (node.kind == TomlKind::Integer && end + 1 < text.size() && text[end] == '#' &&
      isAlnum(text[end + 1])) {
    const std::string_view base = text.substr(node.span.begin, end - node.span.begin);
    const uint32_t digits = end + 1;
    for (end = digits; end < text.size() && (isAlnum(text[end]) || text[end] == '_');)
      ++end;
    const std::string_view prefix = base == "16"  ? "0x"
                                    : base == "8" ? "0o"
                                    : base == "2" ? "0b"
                                                  : "";
    Diagnostic &d =
        diagnostics.report(Code::TomlSyntax, {file.id(), node.span.begin, end},
                           "`" + file.name() + "` is not written as TOML has it",
                           "TOML reads " + std::string(base) + " and a comment after it");
    if (!prefix.empty())
      d.help("write `" + std::string(prefix) + std::string(text.substr(digits, end - digits)) +
             "`");
    return false;
  }
  return std::all_of(node.children.begin(), node.children.end(),
                     [&](const TomlNode &child) { return noBases(child, file, diagnostics); });
}

bool isWordStart(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

uint32_t wordEnd(std::string_view text, uint32_t at) {
  while (at < text.size() &&
         std::string_view(" \t\r\n,]}").find(text[at]) == std::string_view::npos)
    ++at;
  return at;
}

// Whether the place follows a `=`.
bool standsAsValue(std::string_view text, uint32_t at) {
  while (at > 0 && (text[at - 1] == ' ' || text[at - 1] == '\t'))
    --at;
  return at > 0 && text[at - 1] == '=';
}

// toml++'s messages begin with "Error while parsing X: ".
std::string plainMessage(std::string_view description) {
  constexpr std::string_view kPrefix = "Error while parsing ";
  if (description.starts_with(kPrefix))
    description.remove_prefix(kPrefix.size());
  if (const size_t colon = description.find(": "); colon < 24)
    description.remove_prefix(colon + 2);
  std::string message(description);
  for (char &c : message)
    if (c == '\n' || c == '\r')
      c = ' ';
  return message;
}

// `T#`, `TIME#`, `LT#`, `LTIME#` without the quotes.
bool isDuration(std::string_view text) {
  const size_t hash = text.substr(0, 6).find('#');
  const std::string word = lowerCase(text.substr(0, hash == std::string_view::npos ? 0 : hash));
  return word == "t" || word == "time" || word == "lt" || word == "ltime";
}

} // namespace

const TomlNode *TomlNode::find(std::string_view name) const {
  for (const TomlNode &child : children)
    if (child.key == name)
      return &child;
  return nullptr;
}

std::unique_ptr<TomlNode> parseToml(const SourceFile &file, Diagnostics &diagnostics) {
  const Reader reader(file);
  const toml::parse_result result = toml::parse(file.text());
  if (!result) {
    const toml::parse_error &error = result.error();
    Span where = reader.span(error.source());
    const std::string_view text = file.text();
    const bool word = where.begin < text.size() && isWordStart(text[where.begin]);
    where.end = std::max(where.end, word ? wordEnd(text, where.begin) : where.begin);
    if (where.end == where.begin && where.end < text.size() && text[where.end] != '\n')
      ++where.end;
    const std::string reason = plainMessage(error.description());
    // A word where a value should be is text without quotes.
    const bool unquoted =
        word && !reason.starts_with("cannot redefine") && standsAsValue(text, where.begin);
    Diagnostic &d =
        diagnostics.report(Code::TomlSyntax, where, "`" + file.name() + "` is not valid TOML",
                           unquoted ? "not a value" : reason);
    if (unquoted)
      d.help(isDuration(text.substr(where.begin)) ? "durations are text: put it in quotes"
                                                  : "text stands in quotes");
    return nullptr;
  }
  auto tree = std::make_unique<TomlNode>(reader.node(result.table()));
  return noBases(*tree, file, diagnostics) ? std::move(tree) : nullptr;
}

std::string_view describe(const TomlNode &node) {
  switch (node.kind) {
  case TomlKind::Table:
    return "a table";
  case TomlKind::Array:
    return node.arrayOfTables ? "a list of tables" : "a list";
  case TomlKind::String:
    return "text";
  case TomlKind::Integer:
    return "an integer";
  case TomlKind::Floating:
    return "a number with decimals";
  case TomlKind::Boolean:
    return "a truth value";
  case TomlKind::Other:
    break;
  }
  return "a date or time";
}

} // namespace stc
