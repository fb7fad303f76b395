#include "compiler/import/scl_text.hpp"

#include "compiler/import/exp_lines.hpp"
#include "compiler/import/scl_constants.hpp"
#include "compiler/import/texts.hpp"
#include "compiler/source/st_scan.hpp"
#include "runtime/common/text.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include <fmt/format.h>

namespace stc::import {

namespace scl {
namespace {

constexpr size_t kDeepest = 64;

struct Prefix {
  std::string_view from;
  std::string_view to;
};

/// How constants name their types.
constexpr std::array<Prefix, 5> kPrefixes = {
    {{"l#", "DINT#"}, {"b#", "BYTE#"}, {"w#", "WORD#"}, {"dw#", "DWORD#"}, {"lw#", "LWORD#"}}};

/// Constants that are nothing here.
constexpr std::array<std::string_view, 4> kUnknownConstants = {"s5t#", "s5time#", "c#", "p#"};

/// Types that only a Siemens CPU has.
constexpr std::array<std::string_view, 11> kUnknownTypes = {
    "s5time",  "variant",  "any",    "pointer",  "block_fb", "timer",
    "counter", "block_fc", "hw_any", "block_db", "remote"};

bool ends(const SclToken &token, char sign) {
  return token.kind == SclKind::Sign && token.text.size() == 1 && token.text.front() == sign;
}

/// Whether nothing has been written from `from` on.
bool nothingSince(std::string_view out, size_t from) {
  return out.substr(std::min(from, out.size())).find_first_not_of(" \t\r\n\f\v") ==
         std::string_view::npos;
}

bool isOver(const SclToken &token) {
  return token.kind == SclKind::Blank || token.kind == SclKind::Comment ||
         token.kind == SclKind::Attribute;
}

} // namespace
} // namespace scl

void SclText::leaveOut(size_t line, std::string why) {
  if (named_.insert(why).second)
    model_.leftOut.push_back({{file_, line}, object_, std::move(why)});
}

void SclText::changed(size_t line, std::string what) {
  if (named_.insert(what).second)
    model_.changed.push_back({{file_, line}, object_, std::move(what)});
}

/// Comments nest here and do not there.
std::string SclText::comment(std::string_view text) {
  if (text.starts_with("//"))
    return std::string(text);
  std::string_view inside = text;
  inside.remove_prefix(2);
  const bool closed = inside.ends_with("*)") || inside.ends_with("/)");
  inside.remove_suffix(closed ? 2 : 0);
  if (text.starts_with("(/*"))
    inside = inside.substr(1, inside.size() - (inside.ends_with('*') ? 2 : 1));
  std::string out = "(*";
  for (size_t i = 0; i < inside.size(); ++i) {
    out += inside[i];
    const std::string_view pair = inside.substr(i, 2);
    if (pair == "(*" || pair == "*)")
      out += ' ';
  }
  return out + (inside.ends_with('(') ? " *)" : "*)");
}

/// A structure has no literals, so that in statements a constant of the block stands for it.
std::string SclText::date(const SclToken &token) {
  const std::optional<std::string> value = sclDateValue(token.text);
  if (!value) {
    leaveOut(token.line, fmt::format("`{}` is no date and time of a DTL", token.text));
    return std::string(token.text);
  }
  if (!inStatements_)
    return *value;
  std::string name = asIdentifier(token.text);
  dates_.emplace(name, *value);
  return name;
}

std::string SclText::literal(const SclToken &token) {
  const std::string lower = stride::common::lowerCase(token.text);
  if (lower.starts_with("dtl#"))
    return date(token);
  for (const scl::Prefix &each : scl::kPrefixes)
    if (lower.starts_with(each.from))
      return std::string(each.to) + std::string(token.text.substr(each.from.size()));
  for (const std::string_view each : scl::kUnknownConstants)
    if (lower.starts_with(each))
      leaveOut(token.line, fmt::format("constants like `{}` have no counterpart", token.text));
  return std::string(token.text);
}

std::string SclText::plain(const SclToken &token) {
  switch (token.kind) {
  case SclKind::Quoted:
  case SclKind::Local: {
    const std::string_view name = sclName(token);
    std::string here = asIdentifier(name);
    if (here != name)
      changed(token.line, fmt::format("`{}` is called {} here", name, here));
    return here;
  }
  case SclKind::Literal:
    return literal(token);
  case SclKind::Comment:
    return comment(token.text);
  case SclKind::Attribute:
    return {};
  default:
    return std::string(token.text);
  }
}

void SclText::pass(std::string &out) {
  for (; !atEnd() && scl::isOver(now()); ++at_)
    if (now().kind != SclKind::Attribute)
      out += plain(now());
}

std::string SclText::takeName() {
  std::string passed;
  pass(passed);
  if (atEnd() || (now().kind != SclKind::Word && now().kind != SclKind::Quoted &&
                  now().kind != SclKind::Local))
    return {};
  return plain(tokens_[at_++]);
}

const SclToken *SclText::significant(size_t from) const {
  while (from < tokens_.size() && scl::isOver(tokens_[from]))
    ++from;
  return from < tokens_.size() ? &tokens_[from] : nullptr;
}

/// A structure becomes a type of its own, for here only types have one.
void SclText::structure(std::string &out, const std::string &name) {
  const size_t line = now().line;
  skip(); // STRUCT
  if (++depth_ > scl::kDeepest) {
    leaveOut(line, "its structures are nested too deep");
    at_ = limit_;
    return;
  }
  std::string inside;
  members(inside, name, "END_STRUCT", {});
  --depth_;
  hoisted_ += fmt::format("TYPE {} :\nSTRUCT{}END_STRUCT\nEND_TYPE\n\n", name, inside);
  changed(line, fmt::format("a structure without a name became the type {}", name));
  out += name;
}

void SclText::typeWord(const SclToken &token) {
  if (token.kind == SclKind::Word &&
      std::ranges::find(scl::kUnknownTypes, stride::common::lowerCase(token.text)) !=
          scl::kUnknownTypes.end())
    leaveOut(token.line, fmt::format("the type {} has no counterpart", token.text));
}

void SclText::type(std::string &out, const std::string &name) {
  for (; !atEnd(); ++at_) {
    if (isNow("STRUCT")) {
      structure(out, name);
      return;
    }
    if (scl::ends(now(), ';') || now().text == ":=")
      return;
    typeWord(now());
    out += plain(now());
  }
}

void SclText::memberValue(std::string &out, const std::string &name, std::string_view end,
                          const MemberRules &rules) {
  const size_t value = out.size();
  const size_t line = atEnd() ? 0 : now().line;
  for (; !atEnd() && !scl::ends(now(), ';') && !isNow(end); ++at_)
    out += plain(now());
  if (rules.noValues && trimmed(std::string_view(out).substr(value)).starts_with(":=")) {
    out.resize(value);
    while (!out.empty() && out.back() == ' ')
      out.pop_back();
    changed(line, fmt::format("the initial value of `{}` is dropped: it is a VAR_IN_OUT", name));
  }
  if (rules.initial == nullptr)
    return;
  const auto given = rules.initial->find(stride::common::lowerCase(name));
  if (given == rules.initial->end())
    return;
  out.resize(value);
  while (!out.empty() && out.back() == ' ')
    out.pop_back();
  out += " := " + given->second;
  rules.initial->erase(given);
}

void SclText::members(std::string &out, const std::string &owner, std::string_view end,
                      const MemberRules &rules) {
  while (!atEnd()) {
    pass(out);
    if (isNow(end)) {
      skip();
      return;
    }
    const size_t begin = at_;
    const std::string name = takeName();
    if (name.empty()) {
      if (!atEnd())
        out += plain(tokens_[at_++]);
      continue;
    }
    const size_t nameAt = out.size();
    out += name;
    bool viewed = false;
    for (; !atEnd() && !scl::ends(now(), ':') && !scl::ends(now(), ';') && !isNow(end); ++at_) {
      viewed = isNow("AT") && rules.ofBlock && view(out, name, nameAt, owner);
      if (viewed)
        break;
      if (isNow("AT"))
        leaveOut(now().line, fmt::format("`{}` is a view of another variable (AT): the CPU stores "
                                         "the high byte first, Stride the low one",
                                         name));
      out += plain(now());
    }
    if (viewed) // with its `;`: what follows is another member
      continue;
    if (!atEnd() && scl::ends(now(), ':')) {
      out += plain(tokens_[at_++]);
      const size_t written = out.size();
      type(out, fmt::format("{}_{}", owner, name));
      if (rules.ofBlock)
        types_.insert_or_assign(stride::common::lowerCase(name), out.substr(written));
    }
    memberValue(out, name, end, rules);
    if (at_ == begin)
      ++at_;
  }
}

/// `b AT w : DWORD;` of a POU: true when it is kept as a pointer, and passed.
bool SclText::view(std::string &out, const std::string &name, size_t nameAt,
                   const std::string &owner) {
  const size_t at = at_;
  const size_t line = now().line;
  const size_t said = model_.changed.size();
  const std::string hoisted = hoisted_;
  skip(); // AT
  const std::string of = takeName();
  std::string as;
  pass(as);
  as.clear();
  if (!atEnd() && scl::ends(now(), ':')) {
    skip();
    type(as, fmt::format("{}_{}", owner, name));
    std::string blanks; // END_STRUCT ;
    pass(blanks);
  }
  const std::string structure = hoisted_.substr(hoisted.size());
  hoisted_ = hoisted;
  const auto seen = types_.find(stride::common::lowerCase(of));
  const bool plainView = !atEnd() && scl::ends(now(), ';') && seen != types_.end();
  const bool kept = plainView && isSclViewKept(as, seen->second);
  if (!kept && !(plainView && partView(name, of, as, structure, seen->second))) {
    at_ = at;
    return false;
  }
  model_.changed.resize(said); // what was said of a structure that is none here
  skip();
  out.resize(nameAt);
  if (kept)
    views_.insert_or_assign(stride::common::lowerCase(name),
                            View{name, of, std::string(trimmed(as))});
  changed(line, fmt::format("the view `{}` of `{}` (AT) became a pointer to it{}", name, of,
                            kept ? "" : ", its parts bits and bytes of it, the high byte first"));
  return true;
}

/// Whether the token names a variable of the block: neither a member, nor an input in a call.
bool SclText::namesOwn(size_t at) const {
  if (tokens_[at].kind == SclKind::Local)
    return true;
  size_t before = at;
  while (before > 0 && scl::isOver(tokens_[before - 1]))
    --before;
  const std::string_view sign = before > 0 ? tokens_[before - 1].text : std::string_view();
  const SclToken *next = significant(at + 1);
  const bool input =
      (sign == "(" || sign == ",") && next != nullptr && (next->text == ":=" || next->text == "=>");
  return tokens_[at].kind == SclKind::Word && sign != "." && !input;
}

/// Where the rest of the block has the name (in lower case); looked for once for all names.
const std::vector<size_t> &SclText::usesOf(const std::string &name) {
  if (uses_.empty())
    for (size_t i = at_; i < limit_; ++i)
      if (tokens_[i].kind == SclKind::Local || tokens_[i].kind == SclKind::Word)
        uses_[stride::common::lowerCase(asIdentifier(sclName(tokens_[i])))].push_back(i);
  return uses_[name];
}

/// A view of smaller parts: each is a bit or a byte of the variable, as long as the block names
/// them one by one.
bool SclText::partView(const std::string &name, const std::string &of, std::string_view as,
                       std::string_view structure, std::string_view seen) {
  std::optional<SclViewParts> parts = sclViewParts(as, structure, seen);
  if (!parts)
    return false;
  const std::string key = stride::common::lowerCase(name);
  const std::span<const SclToken> tokens = std::span(tokens_).first(limit_);
  for (const size_t i : usesOf(key)) {
    size_t end = 0;
    if (i >= at_ && namesOwn(i) && sclViewPartAt(*parts, tokens, i, end) == nullptr)
      return false;
  }
  std::string type(parts->type);
  views_.insert_or_assign(key, View{name, of, std::move(type), std::move(*parts)});
  return true;
}

/// Whether the token, after that text, names a view of the block.
bool SclText::isView(const SclToken &token, std::string_view before) const {
  const bool local = token.kind == SclKind::Local;
  if (views_.empty() || (!local && token.kind != SclKind::Word))
    return false;
  const std::string_view text = trimmed(before);
  const SclToken *next = significant(at_ + 1);
  const bool input = (text.ends_with('(') || text.ends_with(',')) && next != nullptr &&
                     (next->text == ":=" || next->text == "=>"); // of the block that is called
  return (local || (!input && !text.ends_with('.'))) &&
         views_.contains(stride::common::lowerCase(asIdentifier(sclName(token))));
}

std::string SclText::ownSections() const {
  std::string out;
  for (const auto &[key, one] : views_)
    out += fmt::format("  {} : POINTER TO {};\n", one.name, one.type);
  if (!out.empty())
    out = fmt::format("VAR_TEMP\n{}END_VAR\n", out);
  std::string dates;
  for (const auto &[name, value] : dates_)
    dates += fmt::format("  {} : DTL := {};\n", name, value);
  return dates.empty() ? out : out + fmt::format("VAR CONSTANT\n{}END_VAR\n", dates);
}

std::string SclText::viewStatements() const {
  std::string out;
  for (const auto &[key, one] : views_)
    out += fmt::format("{} := ADR({});\n", one.name, one.of);
  return out;
}

std::string SclText::value() {
  std::string out;
  for (; !atEnd() && !scl::ends(now(), ';'); ++at_)
    out += plain(now());
  if (!atEnd())
    skip();
  return std::string(trimmed(out));
}

/// `REGION a name` to the end of the line becomes a comment, and so does END_REGION.
void SclText::region(std::string &out) {
  out += "//";
  for (bool first = true; !atEnd(); ++at_, first = false) {
    const std::string_view text = now().text;
    const size_t end = text.find('\n');
    if (end != std::string_view::npos && now().kind == SclKind::Blank) {
      statement_ = out.size();
      return;
    }
    out += first ? " " : "";
    out += text;
  }
}

void SclText::address(std::string &out) {
  const SclToken *area = at_ + 1 < tokens_.size() ? &tokens_[at_ + 1] : nullptr;
  out += '%';
  skip();
  if (area == nullptr || area->kind != SclKind::Word || area->text.size() < 2)
    return;
  const char letter = area->text.front();
  const bool bit =
      std::ranges::all_of(area->text.substr(1), [](char c) { return c >= '0' && c <= '9'; });
  if (bit && std::string_view("IQMiqm").find(letter) != std::string_view::npos) {
    out += fmt::format("{}X{}", letter, area->text.substr(1));
    skip();
  } else if (stride::common::lowerCase(area->text).starts_with("db")) {
    leaveOut(area->line, fmt::format("the address %{} lies in a data block", area->text));
  }
}

/// `a += b;` becomes `a := a + (b);`.
void SclText::compound(std::string &out) {
  const char sign = now().text.front();
  const std::string target(trimmed(std::string_view(out).substr(std::min(statement_, out.size()))));
  out += fmt::format(":= {} {} (", target, sign);
  closing_ = true;
  skip();
}

/// `view[3]` is a bit of what it refers to, a view of the same size all of it.
void SclText::viewed(std::string &out) {
  const View &view = views_.at(stride::common::lowerCase(asIdentifier(sclName(now()))));
  out += plain(now()) + "^";
  size_t end = at_ + 1;
  if (!view.parts.parts.empty())
    if (const std::string *part =
            sclViewPartAt(view.parts, std::span(tokens_).first(limit_), at_, end))
      out += "." + *part;
  at_ = end;
}

void SclText::statementToken(std::string &out) {
  static constexpr std::array<std::string_view, 6> kBeginsAfter = {"THEN",   "ELSE", "DO",
                                                                   "REPEAT", "OF",   "BEGIN"};
  const SclToken &token = now();
  const bool compoundSign = token.kind == SclKind::Sign && token.text.size() == 2 &&
                            token.text[1] == '=' &&
                            std::string_view("+-*/").find(token.text[0]) != std::string_view::npos;
  if (compoundSign)
    return compound(out);
  if (scl::ends(token, '%') && (out.empty() || out.back() != '.'))
    return address(out);
  if (scl::ends(token, ';') && closing_) {
    out += ')';
    closing_ = false;
  }
  if (isView(token, out)) {
    viewed(out);
  } else {
    out += isSclWord(token, "GOTO") ? "JMP" : plain(token);
    skip();
  }
  const bool first = scl::nothingSince(out, statement_);
  const bool begins = std::ranges::any_of(
      kBeginsAfter, [&](std::string_view each) { return isSclWord(token, each); });
  if (first || begins || scl::ends(token, ';') || scl::ends(token, ':') ||
      token.kind == SclKind::Comment)
    statement_ = out.size();
}

bool SclText::statements(std::string &out, std::string_view end) {
  inStatements_ = true;
  statement_ = out.size();
  closing_ = false;
  while (!atEnd()) {
    if (isNow(end)) {
      skip();
      return true;
    }
    const SclToken *next = significant(at_ + 1);
    const bool begins = scl::nothingSince(out, statement_);
    if (begins && isNow("REGION") && (next == nullptr || next->text != ":=")) {
      region(out);
    } else if (isNow("END_REGION")) {
      out += "// END_REGION";
      skip();
      if (!atEnd() && scl::ends(now(), ';'))
        skip();
      if (!atEnd() && now().text.find('\n') == std::string_view::npos)
        out += '\n';
      statement_ = out.size();
    } else {
      statementToken(out);
    }
  }
  return false;
}

} // namespace stc::import
