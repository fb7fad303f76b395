// The path of a CNC program, made at compile time.

#include "compiler/assets/cnc/internal.hpp"

#include "runtime/numeric/cnc/queue_file.hpp"
#include "runtime/numeric/cnc/velocity_check.hpp"
#include "runtime/numeric/crc32.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace stc {

namespace {

using namespace stride::cnc;

void reportEnd(const CncProgram &program, const CncDecoded &decoded, Diagnostics &diagnostics) {
  const Span span = decoded.word != nullptr ? decoded.word->span : program.span;
  switch (decoded.end) {
  case CncEnd::Complete:
    break;
  case CncEnd::Endless:
    diagnostics.report(Code::CncJump, span, "the jumps of this program do not end",
                       "a queue needs an end");
    break;
  case CncEnd::Wrong:
    gcode::report(decoded.error, span, diagnostics);
    break;
  case CncEnd::Refused:
    diagnostics.report(Code::CncQueue, span,
                       fmt::format("the path has more than {} objects", kMostCncObjects),
                       "it goes on here");
    break;
  }
}

bool isDrivable(const PathObject &object) {
  return object.moveType == MoveType::Function || object.moveType == MoveType::Jump ||
         (object.velocity > 0 && object.acceleration > 0 && object.deceleration > 0);
}

} // namespace

std::optional<std::vector<PathObject>> cncQueueOf(const CncProgram &program,
                                                  Diagnostics &diagnostics) {
  std::vector<PathObject> programmed;
  CncOrigins origins;
  const CncDecoded decoded = decodeCnc(
      program,
      [&programmed](const PathObject &object) {
        if (programmed.size() == kMostCncObjects)
          return false;
        programmed.push_back(object);
        return true;
      },
      &origins);
  if (decoded.end != CncEnd::Complete) {
    reportEnd(program, decoded, diagnostics);
    return std::nullopt;
  }
  std::optional<std::vector<PathObject>> processed =
      preprocessCnc(program, std::move(programmed), origins, diagnostics);
  if (!processed)
    return std::nullopt;
  std::vector<PathObject> &objects = *processed;
  const auto stands = std::find_if_not(objects.begin(), objects.end(), isDrivable);
  if (stands != objects.end()) {
    diagnostics
        .report(Code::CncSentence, cncSpanOf(program, origins, *stands),
                fmt::format("sentence {} moves with velocity 0", stands->sourceLine),
                "a queue needs velocities")
        .help("say a velocity with F, or as default");
    return std::nullopt;
  }
  const auto count = static_cast<uint32_t>(objects.size());
  objects.resize(count + 2); // the place that stays free, and two at least
  Queue queue{};
  queue.structId = kQueueStructId;
  queue.buffer = reinterpret_cast<uint8_t *>(objects.data());
  queue.size = static_cast<uint32_t>(objects.size() * sizeof(PathObject));
  setQueueContent(queue, {count, kByEditor, {}});
  uint32_t checked = UINT32_MAX; // all of them
  checkVelocities(&queue, checked,
                  {program.settings.angleTolerance.value_or(0) * (M_PI / 180), -1.0});
  objects.resize(count);
  return processed;
}

std::string cncQueueFile(const CncProgram &program, std::span<const PathObject> objects) {
  QueueFileHeader header{static_cast<uint32_t>(objects.size()), kByEditor, {}};
  const std::string &title = program.title.empty() ? program.name : program.title;
  title.copy(header.name, sizeof header.name - 1);
  std::string bytes(static_cast<size_t>(queueFileSize(header.count)), '\0');
  auto *to = reinterpret_cast<uint8_t *>(bytes.data());
  writeQueueFileHeader(header, to);
  to += kQueueFileHeaderSize;
  for (const PathObject &object : objects) {
    writeFileObject(object, to);
    to += sizeof object;
  }
  const uint32_t sum = stride::numeric::crc32(
      0, bytes.data(), static_cast<int64_t>(bytes.size() - kQueueFileChecksumSize));
  std::copy_n(reinterpret_cast<const uint8_t *>(&sum), sizeof sum, to);
  return bytes;
}

} // namespace stc
