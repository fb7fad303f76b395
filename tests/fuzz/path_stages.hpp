#ifndef STRIDE_TESTS_FUZZ_PATH_STAGES_HPP
#define STRIDE_TESTS_FUZZ_PATH_STAGES_HPP
// Path processors with any settings whatever, as stages of a chain.

#include "runtime/numeric/cnc/processors/stream.hpp"
#include "tests/fuzz/path_bytes.hpp"

#include <memory>

namespace stride::fuzz {

/// One processor between two queues.
class Stage {
public:
  virtual ~Stage() = default;
  virtual void begin(cnc::Queue *output) = 0;
  virtual void step(cnc::Queue *input, cnc::Queue *output) = 0;
  /// Objects that a step may put out.
  [[nodiscard]] virtual uint32_t most() const { return cnc::kMostPerStep; }
  [[nodiscard]] bool runs() const {
    return stream.phase == cnc::StreamPhase::Running || stream.phase == cnc::StreamPhase::Draining;
  }
  cnc::StreamState stream{};
};

/// A processor as the bytes say.
std::unique_ptr<Stage> stageOf(Bytes &bytes);

} // namespace stride::fuzz

#endif // STRIDE_TESTS_FUZZ_PATH_STAGES_HPP
