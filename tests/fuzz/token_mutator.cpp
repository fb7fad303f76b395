#include "tests/fuzz/token_mutator.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace stride::fuzz {

namespace {

using Random = std::mt19937_64;
using Pieces = std::vector<Piece>;

// What programs seldom hold and compilers get wrong.
constexpr std::string_view kStrange[] = {
    "0",
    "-1",
    "2147483648",
    "9223372036854775807",
    "-9223372036854775808",
    "18446744073709551616",
    "1E400",
    "1.0E-400",
    "16#FFFFFFFFFFFFFFFF",
    "2#2",
    "T#1d2h3m4s5ms",
    "T#99999999999d",
    "LTIME#1ns",
    "DT#2106-02-07-06:28:15",
    "''",
    "'$'",
    "\"$D83D\"",
    "%MD0",
    "AT %MD4",
    "AT %I*",
    "ARRAY[0..2] OF",
    "ARRAY[*] OF",
    "ARRAY[1..0] OF",
    "POINTER TO",
    "REFERENCE TO",
    "STRING(0)",
    "THIS^",
    "SUPER^",
    ".",
    "..",
    "^",
    "[",
    "]",
    "(",
    ")",
    ",",
    ";",
    ":",
    ":=",
    "=>",
    "+",
    "END_IF",
    "END_VAR",
    "END_PROGRAM",
    "END_FUNCTION_BLOCK",
    "EXTENDS",
    "IMPLEMENTS",
    "VAR",
    "VAR_INPUT",
    "VAR_IN_OUT",
    "VAR_TEMP",
    "VAR CONSTANT",
    "VAR_GLOBAL",
    "METHOD m",
    "PROPERTY p : INT",
    "{IF defined (x)}",
    "{END_IF}",
    "{attribute 'pack_mode' := '1'}",
    "{external}",
    "(*",
    "*)",
    "//",
    "{",
    "}",
    "\xC2\xAC",
    "\xFF",
    "__NEW(",
    "SIZEOF(",
    "ADR(",
};

size_t below(Random &random, size_t count) {
  return count == 0 ? 0 : static_cast<size_t>(random() % count);
}

bool isWordByte(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

template <class Condition>
size_t runLength(std::string_view text, size_t from, Condition condition) {
  while (from < text.size() && condition(text[from]))
    ++from;
  return from;
}

size_t behind(std::string_view text, std::string_view end, size_t from) {
  const size_t found = text.find(end, from);
  return found == std::string_view::npos ? text.size() : found + end.size();
}

size_t quotedLength(std::string_view text) {
  size_t i = 1;
  while (i < text.size() && text[i] != text[0] && text[i] != '\n')
    i += text[i] == '$' ? 2U : 1U;
  return std::min(i + 1, text.size());
}

Piece firstPiece(std::string_view text) {
  const auto piece = [&](PieceKind kind, size_t length) {
    return Piece{kind, text.substr(0, length)};
  };
  const char c = text[0];
  if (isBlank(c))
    return piece(PieceKind::Blank, runLength(text, 0, isBlank));
  if (text.starts_with("//"))
    return piece(PieceKind::Comment, behind(text, "\n", 2));
  if (text.starts_with("(*"))
    return piece(PieceKind::Comment, behind(text, "*)", 2));
  if (c == '{')
    return piece(PieceKind::Comment, behind(text, "}", 1));
  if (c == '\'' || c == '"')
    return piece(PieceKind::Text, quotedLength(text));
  if (c >= '0' && c <= '9')
    return piece(PieceKind::Number,
                 runLength(text, 1, [](char d) { return isWordByte(d) || d == '#'; }));
  if (isWordByte(c))
    return piece(PieceKind::Word, runLength(text, 1, isWordByte));
  for (const std::string_view sign : {":=", "=>", "<=", ">=", "<>", "**", ".."})
    if (text.starts_with(sign))
      return piece(PieceKind::Sign, sign.size());
  return piece(PieceKind::Sign, 1);
}

std::string joined(const Pieces &pieces, size_t mostBytes) {
  std::string out;
  for (const Piece &piece : pieces)
    out += piece.text;
  if (out.size() > mostBytes)
    out.resize(mostBytes);
  return out;
}

/// A range of pieces, mostly a short one.
std::pair<ptrdiff_t, ptrdiff_t> someRange(const Pieces &pieces, Random &random) {
  const size_t begin = below(random, pieces.size());
  const size_t longest = below(random, 4) == 0 ? pieces.size() : 12;
  const size_t end = std::min(pieces.size(), begin + 1 + below(random, longest));
  return {static_cast<ptrdiff_t>(begin), static_cast<ptrdiff_t>(end)};
}

void insert(Pieces &pieces, size_t place, const Pieces &what) {
  pieces.insert(pieces.begin() + static_cast<ptrdiff_t>(place), what.begin(), what.end());
}

void swapTwo(Pieces &pieces, Random &random) {
  const size_t at = below(random, pieces.size());
  const size_t other = below(random, 2) == 0
                           ? below(random, pieces.size())
                           : std::min(pieces.size() - 1, at + 1 + below(random, 4));
  std::swap(pieces[at], pieces[other]);
}

void erase(Pieces &pieces, Random &random) {
  const auto [begin, end] = someRange(pieces, random);
  pieces.erase(pieces.begin() + begin, pieces.begin() + end);
}

void repeat(Pieces &pieces, Random &random) {
  const auto [begin, end] = someRange(pieces, random);
  const Pieces range(pieces.begin() + begin, pieces.begin() + end);
  const size_t times = below(random, 8) == 0 ? 1 + below(random, 300) : 1;
  Pieces all;
  for (size_t i = 0; i < times && all.size() < 4096; ++i)
    all.insert(all.end(), range.begin(), range.end());
  const size_t place =
      below(random, 2) == 0 ? static_cast<size_t>(end) : below(random, pieces.size());
  insert(pieces, place, all);
}

void cut(Pieces &pieces, Random &random) {
  const size_t place = below(random, pieces.size());
  if (below(random, 4) == 0)
    pieces.erase(pieces.begin(), pieces.begin() + static_cast<ptrdiff_t>(place));
  else
    pieces.resize(place);
}

void strange(Pieces &pieces, Random &random) {
  const Piece piece{PieceKind::Sign, kStrange[below(random, std::size(kStrange))]};
  const size_t place = below(random, pieces.size());
  if (below(random, 2) == 0)
    pieces[place] = piece;
  else
    insert(pieces, place, {{PieceKind::Blank, " "}, piece, {PieceKind::Blank, " "}});
}

} // namespace

std::vector<Piece> cutIntoPieces(std::string_view source) {
  Pieces pieces;
  while (!source.empty()) {
    pieces.push_back(firstPiece(source));
    source.remove_prefix(pieces.back().text.size());
  }
  return pieces;
}

namespace {

std::string readWhole(const std::filesystem::path &path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::vector<std::filesystem::path> sortedEntries(const std::filesystem::path &folder) {
  std::vector<std::filesystem::path> entries;
  for (const auto &entry : std::filesystem::directory_iterator(folder))
    entries.push_back(entry.path());
  std::sort(entries.begin(), entries.end());
  return entries;
}

} // namespace

std::vector<std::string> readProjects(const std::vector<std::filesystem::path> &folders,
                                      std::string_view mark, size_t mostBytes) {
  std::vector<std::string> projects;
  for (const std::filesystem::path &folder : folders)
    for (const std::filesystem::path &project : sortedEntries(folder)) {
      if (!std::filesystem::exists(project / "stride.toml"))
        continue;
      std::string text;
      for (const std::filesystem::path &file : sortedEntries(project)) {
        const std::string name = file.filename().string();
        if (name == "stride.toml" || name.ends_with(".st") || name.ends_with(".cam.toml"))
          text += std::string(mark) + name + "\n" + readWhole(file) + "\n";
      }
      if (text.size() <= mostBytes)
        projects.push_back(std::move(text));
    }
  return projects;
}

std::vector<std::string> readSources(const std::vector<std::filesystem::path> &folders,
                                     size_t mostBytes) {
  std::vector<std::filesystem::path> paths;
  for (const std::filesystem::path &folder : folders)
    for (const auto &entry : std::filesystem::recursive_directory_iterator(folder))
      if (entry.path().extension() == ".st" && entry.is_regular_file() &&
          entry.file_size() <= mostBytes)
        paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> sources;
  for (const std::filesystem::path &path : paths)
    sources.push_back(readWhole(path));
  return sources;
}

TokenMutator::TokenMutator(std::vector<std::string> corpus) : corpus_(std::move(corpus)) {
  for (const std::string &source : corpus_)
    for (const Piece &piece : cutIntoPieces(source)) {
      pieces_.push_back(piece);
      byKind_[static_cast<size_t>(piece.kind)].push_back(piece.text);
    }
}

std::string TokenMutator::mutate(std::string_view source, uint64_t seed, size_t mostBytes) const {
  Random random(seed);
  Pieces pieces = cutIntoPieces(source);
  const size_t changes = 1 + below(random, 8);
  for (size_t i = 0; i < changes; ++i) {
    if (pieces.empty())
      pieces.push_back({PieceKind::Blank, " "});
    const size_t place = below(random, pieces.size());
    switch (below(random, 10)) {
    case 0:
      swapTwo(pieces, random);
      break;
    case 1:
      erase(pieces, random);
      break;
    case 2:
      repeat(pieces, random);
      break;
    case 3:
      if (below(random, 4) == 0)
        cut(pieces, random);
      break;
    case 4:
      strange(pieces, random);
      break;
    case 5:
    case 6: { // a piece of the same kind, from here or from elsewhere
      const auto &others = byKind_[static_cast<size_t>(pieces[place].kind)];
      if (const Piece &own = pieces[below(random, pieces.size())]; own.kind == pieces[place].kind)
        pieces[place] = own;
      else if (!others.empty())
        pieces[place].text = others[below(random, others.size())];
      break;
    }
    case 7: // any piece of here
      pieces[place] = pieces[below(random, pieces.size())];
      break;
    case 8: // a word of elsewhere
      if (const auto &words = byKind_[static_cast<size_t>(PieceKind::Word)]; !words.empty())
        insert(pieces, place,
               {{PieceKind::Blank, " "},
                {PieceKind::Word, words[below(random, words.size())]},
                {PieceKind::Blank, " "}});
      break;
    default: // pieces of elsewhere
      if (!pieces_.empty()) {
        const auto [begin, end] = someRange(pieces_, random);
        insert(pieces, place,
               Pieces(pieces_.begin() + begin,
                      pieces_.begin() + std::min<ptrdiff_t>(end, begin + 200)));
      }
    }
  }
  return joined(pieces, mostBytes);
}

std::string TokenMutator::cross(std::string_view first, std::string_view second, uint64_t seed,
                                size_t mostBytes) const {
  Random random(seed);
  Pieces begin = cutIntoPieces(first);
  const Pieces end = cutIntoPieces(second);
  begin.resize(below(random, begin.size() + 1));
  begin.insert(begin.end(), end.begin() + static_cast<ptrdiff_t>(below(random, end.size() + 1)),
               end.end());
  return joined(begin, mostBytes);
}

} // namespace stride::fuzz
