// What the sentences of a CNC program are for, before it is reversed.

#include "compiler/assets/cnc_edit/reverse_plan.hpp"

#include "compiler/assets/cnc_edit/word_edits.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace stc::gcode {

namespace {

using namespace stride::cnc;

/// Topics with a few functions, and which one holds at first.
struct ModeRow {
  int32_t first;
  int32_t last;
  int32_t topic;
  int32_t initial;
};
constexpr ModeRow kModes[] = {{15, 19, kPlaneMode, 17},    {38, 39, kFeatureMode, 39},
                              {40, 42, kToolMode, 40},     {50, 52, kCornerMode, 50},
                              {60, 61, kLoopMode, 60},     {70, 71, kSmoothMode, 70},
                              {90, 91, kRelativeMode, 90}, {98, 99, kCentreMode, 99}};

class Planner {
public:
  Planner(const CncTrace &trace, bool softMotion3, Diagnostics &diagnostics)
      : trace_(trace), softMotion3_(softMotion3), diagnostics_(diagnostics) {
    plan_.modal.emplace_back();
    plan_.modes.emplace_back();
  }

  std::optional<ReversePlan> run() {
    for (size_t i = 0; i < trace_.sentences.size(); ++i)
      if (!add(trace_.sentences[i], trace_.visits[i]))
        return std::nullopt;
    while (plan_.prologue < plan_.sentences.size() && staysInFront(plan_.sentences[plan_.prologue]))
      ++plan_.prologue;
    plan_.positions = !plan_.motions.empty() && isRapid(plan_.motions.front());
    return std::move(plan_);
  }

private:
  bool refuse(const CncWord &word, const std::string &message, const std::string &label,
              const std::string &help) {
    refuseEdit(word.span, message, label, help, diagnostics_);
    return false;
  }

  [[nodiscard]] bool isRapid(size_t sentence) const {
    const int32_t function = plan_.sentences[sentence].function;
    return function == 0 || function == 92;
  }

  /// What prepares a path and has no place on it.
  static bool staysInFront(const PlannedSentence &sentence) {
    return sentence.kind == SentenceKind::Words || sentence.kind == SentenceKind::Function ||
           (sentence.kind == SentenceKind::Mode && sentence.topic <= kCentreMode);
  }

  bool add(const EditSentence &sentence, const CncVisit &visit) {
    const std::span<const CncWord> words = sentence.words;
    PlannedSentence planned;
    planned.modalBefore = plan_.modal.size() - 1;
    planned.modesBefore = plan_.modes.size() - 1;
    const bool isM = wordOf(words, 'M') != nullptr;
    const CncWord *g = isM ? nullptr : wordOf(words, 'G');
    planned.function = g != nullptr ? g->word.integer : visit.function;
    if (!words.empty() && !isM && !checkFunction(sentence, planned.function))
      return false;
    if (isM || planned.function == 4 || planned.function == 75)
      planned.kind = SentenceKind::Function;
    else if (visit.object >= 0 || (g != nullptr && planned.function == 92))
      planned.kind = SentenceKind::Motion;
    else if (g != nullptr)
      addMode(words, planned);
    if (!words.empty() && !check(sentence, planned))
      return false;
    addModal(sentence, planned);
    planned.modalAfter = plan_.modal.size() - 1;
    planned.modesAfter = plan_.modes.size() - 1;
    if (planned.kind == SentenceKind::Motion)
      plan_.motions.push_back(plan_.sentences.size());
    plan_.sentences.push_back(planned);
    return true;
  }

  /// Functions that have no other way round.
  bool checkFunction(const EditSentence &sentence, int32_t function) {
    const CncWord *g = wordOf(sentence.words, 'G');
    const CncWord &place = g != nullptr ? *g : sentence.words.front();
    if (g != nullptr && function == 20)
      return refuse(place, "a program with jumps cannot be reversed", "jumps",
                    "write the sentences of the loop one after another");
    if (g != nullptr && (function == 36 || function == 37))
      return refuse(place, "a program that sets variables cannot be reversed",
                    "would come later, or earlier", "write numbers instead of the variable");
    if (g != nullptr && function >= 54 && function <= 56)
      return refuse(place, "the program moves its coordinates itself",
                    "its words are not places of the path",
                    "write the coordinates of the machine instead");
    if (function == 31 || wordOf(sentence.words, kProbe) != nullptr)
      return refuse(place, "a motion that a probe ends cannot be reversed",
                    "where it ends is not known", "write G1");
    return true;
  }

  /// Words that would have to change.
  bool check(const EditSentence &sentence, const PlannedSentence &planned) {
    if (planned.kind == SentenceKind::Function)
      return true;
    if (sentence.skip)
      return refuse(sentence.words.front(),
                    "this sentence may be suppressed, and others depend on it",
                    "where the path goes on is not known", "take the / or the sentence away");
    if (planned.kind != SentenceKind::Motion)
      return true;
    for (const char letter : std::string_view("XYZABCPQUVWIJKRTHLO"))
      if (const CncWord *word = wordOf(sentence.words, static_cast<uint8_t>(letter));
          word != nullptr && !word->variable.empty())
        return refuse(*word, "a variable says this value, which would have to change",
                      fmt::format("`${}$`", word->variable), "write a number");
    return true;
  }

  void addMode(std::span<const CncWord> words, PlannedSentence &planned) {
    const auto *const row =
        std::find_if(std::begin(kModes), std::end(kModes), [&](const ModeRow &each) {
          return planned.function >= each.first && planned.function <= each.last;
        });
    if (row == std::end(kModes))
      return;
    planned.kind = SentenceKind::Mode;
    planned.topic = row->topic;
    const uint8_t which = row->topic == kFeatureMode  ? static_cast<uint8_t>('O')
                          : row->topic == kSmoothMode ? static_cast<uint8_t>('L')
                                                      : uint8_t{0};
    if (const CncWord *word = wordOf(words, which))
      planned.topic += word->word.integer;
    ModeState state = plan_.modes.back();
    if (planned.function == row->initial)
      state.erase(planned.topic);
    else
      state[planned.topic] = planned.function;
    if (state != plan_.modes.back())
      plan_.modes.push_back(std::move(state));
  }

  void addModal(const EditSentence &sentence, const PlannedSentence &planned) {
    ModalState state = plan_.modal.back();
    const int32_t function = planned.kind == SentenceKind::Mode ? planned.function : -1;
    if (const CncWord *word = readModal(sentence, function, softMotion3_, state))
      refuse(*word, "a variable says which of two this is", "acceleration or deceleration",
             "write a number");
    if (state != plan_.modal.back())
      plan_.modal.push_back(std::move(state));
  }

  const CncTrace &trace_;
  bool softMotion3_;
  Diagnostics &diagnostics_;
  ReversePlan plan_;
};

} // namespace

int32_t modeOf(const ModeState &state, int32_t topic) {
  if (const auto found = state.find(topic); found != state.end())
    return found->second;
  const int32_t kind = topic >= kSmoothMode    ? static_cast<int32_t>(kSmoothMode)
                       : topic >= kFeatureMode ? static_cast<int32_t>(kFeatureMode)
                                               : topic;
  return std::find_if(std::begin(kModes), std::end(kModes),
                      [kind](const ModeRow &row) { return row.topic == kind; })
      ->initial;
}

std::optional<ReversePlan> planReverse(const CncTrace &trace, bool softMotion3,
                                       Diagnostics &diagnostics) {
  const size_t errors = diagnostics.errorCount();
  std::optional<ReversePlan> plan = Planner(trace, softMotion3, diagnostics).run();
  return diagnostics.errorCount() == errors ? std::move(plan) : std::nullopt;
}

} // namespace stc::gcode
