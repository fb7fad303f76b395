#include "runtime/app/carry_report.hpp"

#include "runtime/app/image_moves.hpp"
#include "runtime/app/layout_index.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace stride::app {

namespace {

/// The owner in the keys of roots.
constexpr uint32_t kRoots = kNoIndex;

const char *word(Finding::Kind kind) {
  switch (kind) {
  case Finding::Kind::Renamed:
    return "renamed";
  case Finding::Kind::Converted:
    return "converted";
  case Finding::Kind::Added:
    return "added";
  case Finding::Kind::Dropped:
    return "dropped";
  case Finding::Kind::Reset:
    return "reset";
  case Finding::Kind::Lost:
    return "lost";
  case Finding::Kind::TextShortened:
    return "may be cut";
  case Finding::Kind::ElementsLost:
    return "elements lost";
  case Finding::Kind::EnumeratorsGone:
  case Finding::Kind::RangeNarrowed:
    return "values lost";
  case Finding::Kind::UnionChanged:
    return "union changed";
  }
  return "";
}

std::string rootPath(const RootDesc &root) {
  return root.list != nullptr ? fmt::format("{}.{}", root.list, root.name) : std::string(root.name);
}

} // namespace

bool isLoss(Finding::Kind kind) {
  return kind == Finding::Kind::Lost || kind == Finding::Kind::TextShortened ||
         kind == Finding::Kind::ElementsLost || kind == Finding::Kind::EnumeratorsGone ||
         kind == Finding::Kind::RangeNarrowed || kind == Finding::Kind::UnionChanged;
}

CarryReport::CarryReport(const TypeMatch &match)
    : match_(&match), pool_(poolRoot(match.newApp())), interesting_(match.pairs().size(), -1),
      leaves_(match.newApp().typeCount, -1), keptIn_(match.pairs().size(), -1) {
  refuse();
  visitFields(kRoots, {}, match.roots(), match.addedRoots(), match.droppedRoots(), 1);
  for (const FieldPair &root : match.roots()) {
    if (root.hold == Hold::No && match.newApp().roots + root.newMember != pool_)
      kept_ += keptIn(root.pair);
  }
  for (const ImageMove &move : imageMoves(match.oldApp(), match.newApp())) {
    if (!move.sameType)
      findings_.push_back({Finding::Kind::Lost, move.path, 1, move.oldType, move.newType,
                           "another address and type"});
  }
  std::stable_sort(findings_.begin(), findings_.end(), [](const Finding &a, const Finding &b) {
    return isLoss(a.kind) > isLoss(b.kind);
  });
  if (std::any_of(findings_.begin(), findings_.end(),
                  [](const Finding &f) { return isLoss(f.kind); }))
    verdict_ = Verdict::Losses;
  if (!refusals_.empty())
    verdict_ = Verdict::Refused;
  known_.clear();
}

void CarryReport::add(Key key, Finding finding) {
  const auto [at, fresh] = known_.try_emplace(key, findings_.size());
  if (fresh)
    findings_.push_back(std::move(finding));
  else
    findings_[at->second].places += finding.places;
}

/// There may be something to say about it or what is inside.
bool CarryReport::interesting(uint32_t index) {
  int8_t &known = interesting_[index];
  if (known >= 0)
    return known != 0;
  const TypePair &pair = match_->pair(index);
  bool found = pair.changedName || !pair.added.empty() || !pair.dropped.empty();
  switch (pair.carry) {
  case Carry::Bytes:
    found = found || pair.ranged;
    break;
  case Carry::Slot:
    break;
  case Carry::Fields:
    for (const FieldPair &field : pair.fields)
      found = found || field.renamed || field.hold == Hold::Asked ||
              (field.hold == Hold::No && interesting(field.pair));
    break;
  case Carry::Elements: {
    const TypeDesc &from = match_->oldApp().types[pair.oldType];
    found = found || pair.count != from.elementCount || interesting(pair.element);
    break;
  }
  case Carry::Union:
    found = found || !pair.bitwise;
    break;
  case Carry::Number:
  case Carry::Text:
  case Carry::Names:
  case Carry::Initial:
    found = true;
    break;
  }
  interesting_[index] = found ? 1 : 0;
  return found;
}

void CarryReport::visitFields(uint32_t owner, const std::string &path,
                              const std::vector<FieldPair> &fields,
                              const std::vector<LoneField> &added,
                              const std::vector<LoneField> &dropped, uint64_t places) {
  const StrideAppV1 &a = match_->oldApp();
  const StrideAppV1 &b = match_->newApp();
  const bool roots = owner == kRoots;
  const auto name = [&](const StrideAppV1 &app, uint32_t member) {
    return roots ? rootPath(app.roots[member])
                 : fmt::format("{}.{}", path, app.members[member].name);
  };
  const auto typeName = [&](const StrideAppV1 &app, uint32_t member) {
    return app.types[roots ? app.roots[member].type : app.members[member].type].name;
  };
  const auto hidden = [&](const StrideAppV1 &app, uint32_t member) {
    const uint32_t flags = roots ? app.roots[member].flags : app.members[member].flags;
    return (flags & (kSymHidden | kSymTypeId)) != 0;
  };
  for (const FieldPair &field : fields) {
    const Key key{owner, field.newMember, 1, Finding::Kind::Lost};
    const auto keyed = [&](Finding::Kind kind) { return Key{owner, field.newMember, 1, kind}; };
    if (roots && b.roots + field.newMember == pool_)
      continue; // what is in it is known only when it is carried over
    if (field.hold == Hold::Asked)
      add(keyed(Finding::Kind::Reset),
          {Finding::Kind::Reset, name(b, field.newMember), places, typeName(a, field.oldMember),
           typeName(b, field.newMember), "{attribute 'init_on_onlchange'}"});
    if (field.hold != Hold::No)
      continue;
    if (field.renamed)
      add(keyed(Finding::Kind::Renamed),
          {Finding::Kind::Renamed, name(b, field.newMember), places, typeName(a, field.oldMember),
           typeName(b, field.newMember), fmt::format("was {}", name(a, field.oldMember)),
           name(a, field.oldMember)});
    if (interesting(field.pair))
      visit(field.pair, name(b, field.newMember), places, key, false);
  }
  for (const LoneField &field : added) {
    if (!hidden(b, field.member))
      add({owner, field.member, 1, Finding::Kind::Added},
          {Finding::Kind::Added, name(b, field.member), places, {}, typeName(b, field.member), {}});
  }
  for (const LoneField &field : dropped) {
    if (!hidden(a, field.member))
      add({owner, field.member, 0, Finding::Kind::Dropped}, {Finding::Kind::Dropped,
                                                             name(a, field.member),
                                                             places,
                                                             typeName(a, field.member),
                                                             {},
                                                             {}});
  }
}

namespace {

/// What becomes of the values of an enumeration, for the report.
struct EnumeratorChanges {
  std::string gone;  ///< "without b = 2, c = 3"
  std::string moved; ///< "d = 4 is now 5"
};

EnumeratorChanges enumeratorChanges(const TypePair &pair, const TypeDesc &from,
                                    const EnumeratorDesc *names) {
  EnumeratorChanges out;
  for (const EnumeratorMove &move : pair.moves) {
    const auto *const own =
        std::find_if(names, names + from.memberCount,
                     [&](const EnumeratorDesc &e) { return e.value == move.from; });
    if (move.gone)
      out.gone +=
          fmt::format("{}{} = {}", out.gone.empty() ? "without " : ", ", own->name, move.from);
    else if (move.from != move.to)
      out.moved += fmt::format("{}{} = {} is now {}", out.moved.empty() ? "" : ", ", own->name,
                               move.from, move.to);
  }
  return out;
}

} // namespace

void CarryReport::visit(uint32_t index, const std::string &path, uint64_t places, Key key,
                        bool indexOpen) {
  const TypePair &pair = match_->pair(index);
  const TypeDesc &from = match_->oldApp().types[pair.oldType];
  const TypeDesc &to = match_->newApp().types[pair.newType];
  const auto say = [&](Finding::Kind kind, std::string detail = {}) {
    std::get<Finding::Kind>(key) = kind;
    add(key, {kind, path, places, from.name, to.name, std::move(detail)});
  };
  if (pair.ranged)
    return say(Finding::Kind::RangeNarrowed, fmt::format("those outside of {}..{}", to.lowerBound,
                                                         static_cast<int64_t>(to.elementCount)));
  switch (pair.carry) {
  case Carry::Bytes:
  case Carry::Slot:
    return;
  case Carry::Number:
    return say(Finding::Kind::Converted);
  case Carry::Text:
    return say(to.stringLength < from.stringLength ? Finding::Kind::TextShortened
                                                   : Finding::Kind::Converted);
  case Carry::Initial:
    return say(Finding::Kind::Lost);
  case Carry::Names: {
    const EnumeratorChanges changes =
        enumeratorChanges(pair, from, match_->oldApp().enumerators + from.firstMember);
    if (!changes.gone.empty())
      return say(Finding::Kind::EnumeratorsGone, changes.gone);
    return say(Finding::Kind::Converted, changes.moved);
  }
  case Carry::Elements: {
    if (pair.count != from.elementCount)
      say(Finding::Kind::ElementsLost,
          fmt::format("{} of {} elements are kept", pair.count, from.elementCount));
    if (!interesting(pair.element))
      return;
    const int64_t first = to.lowerBound + static_cast<int64_t>(pair.newFirst);
    const std::string stem = indexOpen ? path.substr(0, path.size() - 1) + "," : path + "[";
    ++std::get<2>(key);
    return visit(pair.element, fmt::format("{}{}]", stem, first), places * pair.count, key, true);
  }
  case Carry::Union:
    if (pair.changedName || !pair.dropped.empty() ||
        std::any_of(pair.fields.begin(), pair.fields.end(),
                    [&](const FieldPair &field) { return !match_->pair(field.pair).bitwise; }))
      say(Finding::Kind::UnionChanged);
    return;
  case Carry::Fields:
    if (pair.changedName)
      say(Finding::Kind::Converted, "by the names of its fields");
    return visitFields(index, path, pair.fields, pair.added, pair.dropped, places);
  }
}

uint64_t CarryReport::leaves(uint32_t newType) {
  if (leaves_[newType] >= 0)
    return static_cast<uint64_t>(leaves_[newType]);
  const TypeDesc &type = match_->newApp().types[newType];
  uint64_t count = 1;
  if (type.kind == Kind::Array) {
    count = type.elementCount * leaves(type.element);
  } else if (hasMembers(type.kind) && type.kind != Kind::Union) {
    count = 0;
    for (uint32_t i = 0; i < type.memberCount; ++i)
      count += leaves(match_->newApp().members[type.firstMember + i].type);
  }
  leaves_[newType] = static_cast<int64_t>(count);
  return count;
}

uint64_t CarryReport::keptIn(uint32_t index) {
  if (keptIn_[index] >= 0)
    return static_cast<uint64_t>(keptIn_[index]);
  const TypePair &pair = match_->pair(index);
  uint64_t count = 1;
  if (pair.bitwise) {
    count = leaves(pair.newType);
  } else if (pair.carry == Carry::Initial) {
    count = 0;
  } else if (pair.carry == Carry::Elements) {
    count = pair.count * keptIn(pair.element);
  } else if (pair.carry == Carry::Fields) {
    count = 0;
    for (const FieldPair &field : pair.fields)
      count += field.hold == Hold::No ? keptIn(field.pair) : 0;
  }
  keptIn_[index] = static_cast<int64_t>(count);
  return count;
}

std::string CarryReport::text(bool all) const {
  std::string out;
  switch (verdict_) {
  case Verdict::Silent:
    out = fmt::format("{} values are carried over, none is lost\n", kept_);
    break;
  case Verdict::Losses:
    out = fmt::format("{} values are carried over, some are lost\n", kept_);
    break;
  case Verdict::Refused:
    out = "an online change is not possible\n";
    for (const std::string &refusal : refusals_)
      out += "  " + refusal + "\n";
    break;
  }
  if (all)
    for (const std::string &line : atNextStart_)
      out += "  " + line + "\n";
  for (const Finding &finding : findings_) {
    if (!all && !isLoss(finding.kind))
      continue;
    out += fmt::format("  {}: {}", word(finding.kind), finding.path);
    if (finding.oldType.empty() || finding.newType.empty())
      out += fmt::format(" : {}", finding.oldType.empty() ? finding.newType : finding.oldType);
    else if (finding.oldType != finding.newType)
      out += fmt::format(" : {} -> {}", finding.oldType, finding.newType);
    else
      out += fmt::format(" : {}", finding.newType);
    if (!finding.detail.empty())
      out += fmt::format(" ({})", finding.detail);
    if (finding.places > 1)
      out += fmt::format(" in {} places", finding.places);
    out += '\n';
  }
  return out;
}

} // namespace stride::app
