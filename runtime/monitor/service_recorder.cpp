// Operations of the recorder.
#include "runtime/monitor/request_fields.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace stride::monitor {

namespace {

using nlohmann::json;

/// Lines in one answer.
constexpr uint64_t kMostLines = 10'000;
constexpr size_t kMostText = size_t{1} << 20;

TriggerEdge edgeNamed(const std::string &name) {
  static constexpr std::pair<const char *, TriggerEdge> kEdges[] = {
      {"rising", TriggerEdge::Rising},
      {"falling", TriggerEdge::Falling},
      {"high", TriggerEdge::High},
      {"low", TriggerEdge::Low}};
  for (const auto &[known, edge] : kEdges)
    if (name == known)
      return edge;
  throw ServiceError{"bad_request", "'edge' is rising, falling, high or low"};
}

TriggerSettings triggerOf(const json &request) {
  if (!request.is_object())
    throw ServiceError{"bad_request", "'trigger' is an object with 'name', 'edge' and 'threshold'"};
  return {textField(request, "name"), edgeNamed(textField(request, "edge", "rising")),
          textField(request, "threshold", "")};
}

const char *stateName(Recorder::State state) {
  switch (state) {
  case Recorder::State::Armed:
    return "armed";
  case Recorder::State::Triggered:
    return "triggered";
  case Recorder::State::Done:
    return "done";
  }
  return "";
}

std::shared_ptr<Recorder> recorderOf(const ServedApplication &application) {
  std::shared_ptr<Recorder> recorder = application.symbols->recorder();
  if (!recorder)
    throw ServiceError{"no_recording", "nothing is recorded; begin with 'record'"};
  return recorder;
}

json describeRecorder(const Recorder &recorder) {
  json result = {{"state", stateName(recorder.state())},
                 {"taken", recorder.taken()},
                 {"rows", recorder.rows()}};
  if (const std::optional<size_t> row = recorder.triggerRow())
    result["trigger_row"] = *row;
  if (!recorder.endedBy().empty())
    result["ended_by"] = recorder.endedBy();
  return result;
}

} // namespace

json Service::record(const json &request) {
  const ServedApplication &application = running(applicationOf(request));
  RecorderSettings settings;
  settings.names = namesField(request);
  settings.rows = countField(request, "rows", 1000, Recorder::kMostBytes);
  settings.before = realField(request, "before", 0.0);
  if (const auto trigger = request.find("trigger"); trigger != request.end())
    settings.trigger = triggerOf(*trigger);
  auto recorder = std::make_shared<Recorder>(application.symbols->symbols(), settings);
  application.symbols->setRecorder(recorder);
  return describeRecorder(*recorder);
}

json Service::recordState(const json &request) const {
  return describeRecorder(*recorderOf(running(applicationOf(request))));
}

json Service::recordStop(const json &request) {
  const std::shared_ptr<Recorder> recorder = recorderOf(running(applicationOf(request)));
  recorder->stop();
  return describeRecorder(*recorder);
}

json Service::recordRead(const json &request) const {
  const std::shared_ptr<Recorder> recorder = recorderOf(running(applicationOf(request)));
  if (recorder->state() != Recorder::State::Done)
    throw ServiceError{"not_done", "the recording is not done yet; 'record_stop' ends it"};
  const uint64_t from = countField(request, "from", 0, UINT64_MAX);
  const uint64_t count = countField(request, "count", 1000, kMostLines);
  json lines = json::array();
  size_t size = 0;
  for (uint64_t row = from; row < recorder->rows() && lines.size() < count && size < kMostText;
       ++row) {
    std::string line;
    recorder->appendLine(static_cast<size_t>(row), line);
    size += line.size();
    lines.push_back(std::move(line));
  }
  return {{"header", recorder->header()}, {"rows", recorder->rows()}, {"lines", std::move(lines)}};
}

} // namespace stride::monitor
