// The sections of a DXF file.
#include "compiler/assets/dxf/drawing.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace stc::dxf {

namespace {

constexpr std::string_view kBinary = "AutoCAD Binary DXF";

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

class SectionReader {
public:
  SectionReader(const SourceFile &file, Faults &faults)
      : file_(file), faults_(faults), pairs_(file, 0, file.text().size(), faults) {}

  Drawing read() {
    if (file_.text().starts_with(kBinary)) {
      faults_.report({file_.id(), 0, 0}, "this is a binary DXF file", "only ASCII DXF is read",
                     "save the drawing as ASCII DXF");
      return {};
    }
    bool ended = false;
    while (!ended && next()) {
      if (pair_.code == 999)
        continue;
      if (is("SECTION"))
        section();
      else if (is("EOF"))
        ended = true;
      else
        faults_.report(pair_.span, fmt::format("`{}` stands outside of all sections", pair_.value),
                       "a SECTION or EOF is expected here", kDamaged);
    }
    if (!ended)
      faults_.report(pairs_.here(), "the file ends without EOF", "here",
                     "the file is not complete: save the drawing again");
    return std::move(drawing_);
  }

private:
  static constexpr auto kDamaged = "this is no DXF, or a damaged one: save the drawing again";

  bool next() {
    const std::optional<Pair> pair = pairs_.next();
    if (pair)
      pair_ = *pair;
    return pair.has_value();
  }
  [[nodiscard]] bool is(std::string_view word) const {
    return pair_.code == 0 && pair_.value == word;
  }

  /// The next group has to be there: `where` says what is not complete.
  bool need(std::string_view where) {
    if (next())
      return true;
    faults_.report(pairs_.here(), fmt::format("the file ends within {}", where), "here",
                   "the file is not complete: save the drawing again");
    return false;
  }

  void section() {
    if (!need("a section"))
      return;
    if (pair_.code != 2) {
      faults_.report(pair_.span, "a section without a name", "group code 2 is expected here",
                     kDamaged);
      return;
    }
    const std::string_view name = pair_.value;
    if (!need("a section"))
      return;
    if (name == "HEADER")
      header();
    else if (name == "TABLES")
      tables();
    else if (name == "BLOCKS")
      blocks();
    else if (name == "ENTITIES")
      entities(drawing_.entities);
    else
      while (!is("ENDSEC") && need("a section")) {
      }
    if (!faults_.any() && !is("ENDSEC"))
      faults_.report(pair_.span,
                     fmt::format("`{}` does not stand in a section of entities", pair_.value),
                     "ENDSEC is expected here", kDamaged);
  }

  void header() {
    while (!is("ENDSEC")) {
      const bool unit = pair_.code == 9 && pair_.value == "$INSUNITS";
      if (!need("the header"))
        return;
      if (unit && pair_.code == 70)
        drawing_.unit = integerOf(pair_, faults_);
    }
  }

  void tables() {
    while (!is("ENDSEC"))
      if (!is("LAYER")) {
        if (!need("the tables"))
          return;
      } else if (!layer()) {
        return;
      }
  }

  /// One row of the table of layers.
  bool layer() {
    std::string name;
    Layer layer;
    do {
      if (!need("the tables"))
        return false;
      if (pair_.code == 2)
        name = pair_.value;
      else if (pair_.code == 70)
        layer.hidden = layer.hidden || (integerOf(pair_, faults_) & 1) != 0;
      else if (pair_.code == 62)
        layer.hidden = layer.hidden || integerOf(pair_, faults_) < 0;
    } while (pair_.code != 0);
    if (!name.empty())
      drawing_.layers[name] = layer;
    return true;
  }

  void blocks() {
    while (is("BLOCK"))
      if (!block())
        return;
  }

  bool block() {
    Block block;
    std::string name;
    const Span where = pair_.span;
    do {
      if (!need("a block"))
        return false;
      if (pair_.code == 2)
        name = pair_.value;
      else if (pair_.code == 10)
        block.base.x = numberOf(pair_, faults_);
      else if (pair_.code == 20)
        block.base.y = numberOf(pair_, faults_);
    } while (pair_.code != 0);
    entities(block.entities);
    if (faults_.any())
      return false;
    if (!is("ENDBLK")) {
      faults_.report(pair_.span, fmt::format("block `{}` does not end", name),
                     "ENDBLK is expected here", kDamaged);
      return false;
    }
    do
      if (!need("a block"))
        return false;
    while (pair_.code != 0);
    if (!drawing_.blocks.emplace(name, std::move(block)).second)
      faults_.report(where, fmt::format("there are two blocks `{}`", name), "the second one",
                     "give each block a name of its own");
    return !faults_.any();
  }

  /// Up to a word that is no entity.
  void entities(std::vector<Entity> &list) {
    while (!faults_.any() && !is("ENDSEC") && !is("ENDBLK") && !is("EOF") && !is("SECTION") &&
           !is("BLOCK")) {
      Entity entity;
      entity.type = pair_.value;
      entity.span = pair_.span;
      entity.begin = pairs_.place();
      do {
        entity.end = pairs_.place();
        if (!need("an entity"))
          return;
      } while (pair_.code != 0);
      if (++count_ > kMostEntities) {
        faults_.report(entity.span,
                       fmt::format("this drawing has more than {} entities", kMostEntities), "here",
                       "divide it");
        return;
      }
      list.push_back(entity);
    }
  }

  const SourceFile &file_;
  Faults &faults_;
  Pairs pairs_;
  Pair pair_;
  Drawing drawing_;
  size_t count_ = 0;
};

} // namespace

bool NoCase::operator()(std::string_view a, std::string_view b) const {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(),
                                      [](char x, char y) { return lower(x) < lower(y); });
}

Drawing readDrawing(const SourceFile &file, Faults &faults) {
  return SectionReader(file, faults).read();
}

} // namespace stc::dxf
