#include "compiler/export/declaration_texts.hpp"

#include "compiler/source/identifier.hpp"
#include "compiler/syntax/characters.hpp"
#include "compiler/syntax/instruction_list.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace stc::exporting {

namespace {

using namespace ast;

// ---- the text in pieces

struct Piece {
  enum class Kind { Blank, Comment, Pragma, Word, Other };
  Kind kind = Kind::Other;
  size_t begin = 0;
  size_t end = 0;
};

/// After the quote that closes the one at `at`.
size_t endOfQuoted(std::string_view text, size_t at) {
  const char quote = text[at];
  for (++at; at < text.size() && text[at] != quote && text[at] != '\n'; ++at)
    if (text[at] == '$')
      ++at;
  return std::min(at + 1, text.size());
}

size_t endOfPragma(std::string_view text, size_t at) {
  for (++at; at < text.size() && text[at] != '}'; ++at)
    if (text[at] == '\'')
      at = endOfQuoted(text, at) - 1;
  return std::min(at + 1, text.size());
}

Piece pieceAt(std::string_view text, size_t at) {
  const std::string_view two = text.substr(at, 2);
  const char c = text[at];
  if (two == "//" || two == "(*" || two == "/*")
    return {Piece::Kind::Comment, at, commentEnd(text, at)};
  if (c == '{')
    return {Piece::Kind::Pragma, at, endOfPragma(text, at)};
  if (c == '\'' || c == '"')
    return {Piece::Kind::Other, at, endOfQuoted(text, at)};
  size_t end = at;
  if (isLetter(c)) {
    while (end < text.size() && isWordChar(text[end]))
      ++end;
    return {Piece::Kind::Word, at, end};
  }
  const auto isBlank = [&](size_t i) {
    return text[i] == ' ' || text[i] == '\t' || text[i] == '\n' || text[i] == '\r';
  };
  if (!isBlank(at))
    return {Piece::Kind::Other, at, at + 1};
  while (end < text.size() && isBlank(end))
    ++end;
  return {Piece::Kind::Blank, at, end};
}

bool isTrivia(const Piece &piece) {
  return piece.kind == Piece::Kind::Blank || piece.kind == Piece::Kind::Comment ||
         piece.kind == Piece::Kind::Pragma;
}

bool isConditional(std::string_view pragma) {
  size_t begin = 1;
  while (begin < pragma.size() && (pragma[begin] == ' ' || pragma[begin] == '\t'))
    ++begin;
  size_t end = begin;
  while (end < pragma.size() && isWordChar(pragma[end]))
    ++end;
  constexpr std::array<std::string_view, 6> kWords = {"if",     "elsif",  "else",
                                                      "end_if", "define", "undefine"};
  const std::string word = lowerCase(pragma.substr(begin, end - begin));
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

// ---- what the pieces belong to

/// A declaration and where it is.
struct Region {
  const Decl *decl = nullptr;
  size_t begin = 0;
  size_t end = 0;     ///< 0: the word END_PROPERTY ends it
  size_t headEnd = 0; ///< of POUs
  size_t cut = 0;     ///< where END_… begins; of others: the end
  bool isPou = false;
};

class Regions {
public:
  explicit Regions(FileId file) : file_(file) {}

  void add(const Decl *decl) {
    switch (decl->kind) {
    case DeclKind::Structure:
    case DeclKind::Enumeration:
    case DeclKind::Alias:
    case DeclKind::Globals:
      insert({decl, decl->span.begin, decl->span.end, 0, decl->span.end, false});
      return;
    case DeclKind::Config:
    case DeclKind::Access:
    case DeclKind::Configuration:
      whole_ = true;
      return;
    case DeclKind::Property:
      return addProperty(as<PropertyDecl>(decl));
    default:
      return addPou(static_cast<const PouDecl *>(decl));
    }
  }

  [[nodiscard]] bool onlyAsAWhole() const { return whole_; }
  /// By their beginnings; inner ones follow outer ones.
  std::vector<Region> sorted() {
    std::sort(regions_.begin(), regions_.end(),
              [](const Region &a, const Region &b) { return a.begin < b.begin; });
    return regions_;
  }

private:
  void insert(const Region &region) {
    whole_ = whole_ || !region.decl->space.empty() || !region.decl->usings.empty();
    if (region.decl->span.file == file_)
      regions_.push_back(region);
  }

  void addPou(const PouDecl *pou) {
    whole_ = whole_ || (pou->span.file == file_ && !pou->endSpan.valid());
    insert({pou, pou->span.begin, pou->endSpan.end, pou->span.end, pou->endSpan.begin, true});
    for (const PouDecl *each : pou->methods)
      addPou(each);
    for (const PouDecl *each : pou->actions)
      addPou(each);
    for (const PropertyDecl *each : pou->properties)
      addProperty(each);
  }

  void addProperty(const PropertyDecl *property) {
    insert({property, property->span.begin, 0, property->span.end, 0, true});
    for (const PouDecl *each : {property->get, property->set})
      if (each != nullptr) // `GET` alone has no END_GET: it is empty
        insert({each, each->span.begin, each->endSpan.valid() ? each->endSpan.end : each->span.end,
                each->span.end, each->endSpan.valid() ? each->endSpan.begin : each->span.end,
                true});
  }

  FileId file_;
  std::vector<Region> regions_;
  bool whole_ = false;
};

/// Gives each piece to the innermost declaration that it is in. Comments and pragmas before a
/// declaration belong to it; what follows on the same line belongs to what stands before it.
class Distributor {
public:
  Distributor(std::string_view text, std::vector<Region> regions)
      : text_(text), regions_(std::move(regions)) {}

  FileTexts run() {
    for (size_t at = 0; at < text_.size();) {
      const Piece piece = pieceAt(text_, at);
      at = piece.end;
      if (piece.kind == Piece::Kind::Pragma && isConditional(of(piece)))
        out_.onlyAsAWhole = true;
      if (isTrivia(piece))
        pending_.push_back(piece);
      else
        take(piece);
    }
    giveEndOfLine();
    while (!open_.empty())
      close();
    if (last_ != nullptr)
      out_.texts[last_].tail += takePending();
    return std::move(out_);
  }

private:
  struct Open {
    Region region;
    size_t split = 0;          ///< where the declaration ends in `own`
    bool inDeclaration = true; ///< the last piece belonged to it
    size_t wordBegin = 0;      ///< of the last word in `own`
    std::string own;
  };

  [[nodiscard]] std::string_view of(const Piece &piece) const {
    return text_.substr(piece.begin, piece.end - piece.begin);
  }

  std::string takePending() {
    std::string text;
    for (const Piece &each : pending_)
      text += of(each);
    pending_.clear();
    return text;
  }

  void take(const Piece &piece) {
    giveEndOfLine();
    while (!open_.empty() && open_.back().region.end != 0 && open_.back().region.end <= piece.begin)
      close();
    while (next_ < regions_.size() && regions_[next_].begin <= piece.begin) {
      Open open;
      open.region = regions_[next_++];
      out_.texts[open.region.decl].leading = takePending();
      open_.push_back(std::move(open));
    }
    if (open_.empty())
      return;
    Open &open = open_.back();
    const bool closesProperty =
        open.region.end == 0 && equalIgnoringCase(of(piece), "end_property");
    open.own += takePending();
    if (closesProperty)
      close();
    else if (open.region.cut == 0 || piece.begin < open.region.cut)
      append(open, piece);
  }

  /// The rest of the line of the last piece: comments, but no pragmas.
  void giveEndOfLine() {
    size_t count = 0;
    std::string rest;
    bool comment = false;
    for (; count < pending_.size(); ++count) {
      const std::string_view text = of(pending_[count]);
      const size_t line = text.find('\n');
      if (pending_[count].kind == Piece::Kind::Pragma)
        return;
      if (pending_[count].kind == Piece::Kind::Blank && line != std::string_view::npos)
        break;
      comment = comment || pending_[count].kind == Piece::Kind::Comment;
      rest += text;
    }
    if (!comment)
      return;
    if (!open_.empty() && !open_.back().own.empty()) {
      Open &open = open_.back();
      open.own += rest;
      if (open.inDeclaration)
        open.split = open.own.size();
    } else if (last_ != nullptr) {
      out_.texts[last_].tail += rest;
    } else {
      return;
    }
    pending_.erase(pending_.begin(), pending_.begin() + static_cast<ptrdiff_t>(count));
  }

  void append(Open &open, const Piece &piece) {
    const std::string_view text = of(piece);
    const bool beforeName = open.region.isPou && piece.begin < open.region.decl->name.span.begin;
    if (beforeName && text == ".") { // `METHOD Block.Name`: whose it is, the file says otherwise
      open.own.erase(open.wordBegin);
      return;
    }
    open.wordBegin = open.own.size();
    open.own += text;
    const bool endVar = piece.kind == Piece::Kind::Word && equalIgnoringCase(text, "end_var");
    const bool inHead = piece.end <= open.region.headEnd;
    const bool endsHead = open.inDeclaration && (text == ";" || text == ":");
    open.inDeclaration = endVar || inHead || endsHead;
    if (open.inDeclaration)
      open.split = open.own.size();
  }

  void close() {
    Open open = std::move(open_.back());
    open_.pop_back();
    DeclarationText &text = out_.texts[open.region.decl];
    const size_t split = open.region.isPou ? open.split : open.own.size();
    text.declaration = open.own.substr(0, split);
    text.body = open.own.substr(split);
    last_ = open.region.decl;
  }

  std::string_view text_;
  std::vector<Region> regions_;
  size_t next_ = 0;
  std::vector<Open> open_;
  std::vector<Piece> pending_; ///< blanks, comments and pragmas since the last other piece
  const Decl *last_ = nullptr;
  FileTexts out_;
};

} // namespace

bool isListBody(std::string_view body) {
  size_t at = 0;
  while (at < body.size() && isTrivia(pieceAt(body, at)))
    at = pieceAt(body, at).end;
  return isInstructionList(body.substr(at));
}

FileTexts declarationTexts(const File &file, std::string_view text) {
  Regions regions(file.id);
  for (const Decl *each : file.declarations)
    regions.add(each);
  for (const StrayMember &each : file.strayMembers)
    regions.add(each.member);
  const bool whole = regions.onlyAsAWhole();
  FileTexts texts = Distributor(text, regions.sorted()).run();
  texts.onlyAsAWhole = texts.onlyAsAWhole || whole;
  return texts;
}

} // namespace stc::exporting
