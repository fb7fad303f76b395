// What an online change does to the variables, before it is done.
#ifndef STRIDE_RUNTIME_APP_CARRY_REPORT_HPP
#define STRIDE_RUNTIME_APP_CARRY_REPORT_HPP

#include "runtime/app/type_match.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace stride::app {

/// Whether a new build can take over from a running one.
enum class Verdict : uint8_t {
  Silent,  ///< Every value that both builds have is kept.
  Losses,  ///< Some values are lost; the findings name them.
  Refused, ///< It must be started anew; the refusals say why.
};

/// One difference between the builds.
struct Finding {
  enum class Kind : uint8_t {
    Renamed,         ///< Kept under its new name.
    Converted,       ///< Kept in another type.
    Added,           ///< New: its initial value.
    Dropped,         ///< The new build does not have it.
    Reset,           ///< {attribute 'init_on_onlchange'}: its initial value.
    Lost,            ///< Its new type cannot take the value: the initial value.
    TextShortened,   ///< A longer text will be cut.
    ElementsLost,    ///< Elements outside of the new bounds.
    EnumeratorsGone, ///< Values that the new enumeration does not have become the initial value.
    RangeNarrowed,   ///< Values outside of the new subrange become the initial value.
    UnionChanged,    ///< Kept are the bytes of the fields that did not change.
  };
  Kind kind;
  std::string path;      ///< Of the first place.
  uint64_t places = 1;   ///< In how many instances and array elements.
  std::string oldType;   ///< Empty for Added.
  std::string newType;   ///< Empty for Dropped.
  std::string detail;    ///< More words, or empty.
  std::string oldPath{}; ///< Renamed: what it was, in the first place.
};

/// True for the kinds that make Verdict::Losses.
bool isLoss(Finding::Kind kind);

/// The comparison of two builds in words.
class CarryReport {
public:
  explicit CarryReport(const TypeMatch &match);

  Verdict verdict() const { return verdict_; }
  /// What makes an online change impossible, one sentence each.
  const std::vector<std::string> &refusals() const { return refusals_; }
  const std::vector<Finding> &findings() const { return findings_; }
  /// Elementary values that are taken over.
  uint64_t keptValues() const { return kept_; }

  /// Several lines: the verdict, then the findings; `all`: also those without a loss.
  std::string text(bool all) const;
  /// Parameters of the PLC configuration that differ: the drivers keep those they were started
  /// with.
  const std::vector<std::string> &atNextStart() const { return atNextStart_; }

private:
  /// Owning pair, field, 0 for old fields or 1 + array depth for new ones, kind.
  using Key = std::tuple<uint32_t, uint32_t, uint32_t, Finding::Kind>;
  void refuse();
  void compareAxisGroups();
  void compareAxisGroup(const AxisGroupDesc &was, const AxisGroupDesc &is);
  void compareIoDevices();
  /// A section of the PLC configuration: where its parameters begin, and their number.
  struct Section {
    uint32_t first;
    uint32_t count;
  };
  void compareParameters(const std::string &owner, Section was, Section is);
  void add(Key key, Finding finding);
  void visitFields(uint32_t owner, const std::string &path, const std::vector<FieldPair> &fields,
                   const std::vector<LoneField> &added, const std::vector<LoneField> &dropped,
                   uint64_t places);
  void visit(uint32_t pair, const std::string &path, uint64_t places, Key key, bool indexOpen);
  bool interesting(uint32_t pair);
  uint64_t leaves(uint32_t newType);
  uint64_t keptIn(uint32_t pair);

  const TypeMatch *match_;
  const RootDesc *pool_; ///< Of the new build; looked for once, there may be very many roots.
  Verdict verdict_ = Verdict::Silent;
  std::vector<std::string> refusals_;
  std::vector<std::string> atNextStart_;
  std::vector<Finding> findings_;
  std::map<Key, size_t> known_;
  std::vector<int8_t> interesting_; ///< By pair: -1 not known yet.
  std::vector<int64_t> leaves_;     ///< By new type: -1 not known yet.
  std::vector<int64_t> keptIn_;     ///< By pair: -1 not known yet.
  uint64_t kept_ = 0;
};

} // namespace stride::app

#endif
