#include "compiler/import/exp_tasks.hpp"

#include "compiler/import/exp_lines.hpp"

#include <array>

#include <fmt/format.h>

namespace stc::import {

namespace {

/// The numbers of `{Additional_info : 1,0,0,0,1,4294967295}`.
std::vector<std::string> numbersOf(std::string_view pragma) {
  std::vector<std::string> numbers;
  const size_t colon = pragma.find(':');
  const size_t end = pragma.find('}');
  if (colon == std::string_view::npos || end == std::string_view::npos || end < colon)
    return numbers;
  std::string_view list = pragma.substr(colon + 1, end - colon - 1);
  while (!list.empty()) {
    const size_t comma = std::min(list.find(','), list.size());
    numbers.emplace_back(trimmed(list.substr(0, comma)));
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
  return numbers;
}

class Resource {
public:
  Resource(const std::vector<std::string> &lines, const Origin &origin, Model &model)
      : lines_(lines), origin_(origin), model_(model) {}

  void read() {
    for (at_ = 0; at_ < lines_.size(); ++at_)
      readLine(trimmed(lines_[at_]));
  }

private:
  [[nodiscard]] Origin here() const { return {origin_.file, origin_.line + at_}; }

  void readLine(std::string_view line) {
    const std::string_view word = firstWord(line);
    if (word == "TASK") {
      model_.tasks.push_back(taskOf(line));
      model_.tasks.back().origin = here();
      inTask_ = true;
    } else if (word == "END_TASK") {
      if (inTask_)
        settleKind();
      inTask_ = false;
    } else if (line.starts_with("{Additional_info")) {
      info_ = numbersOf(line);
    } else if (line.starts_with("{event_task ")) {
      systemEvent(line);
    } else if (inTask_ && line.ends_with("();")) {
      model_.tasks.back().programs.emplace_back(trimmed(line.substr(0, line.size() - 3)));
    } else if (inTask_ && !line.empty() && line.front() != '{') {
      model_.leftOut.push_back(
          {here(), fmt::format("line `{}`", line),
           "it is no call of a program without arguments; call the program in another one"});
    }
  }

  /// What starts a task: 1 its interval, 2 nothing; others have been seen nowhere.
  void settleKind() {
    Task &task = model_.tasks.back();
    const std::string kind = info_.empty() ? std::string() : info_[0];
    const auto change = [&](std::string text) {
      model_.changed.push_back({task.origin, "task " + task.name, std::move(text)});
    };
    if (kind == "1" && !task.event.empty() && !task.interval.empty()) {
      change(fmt::format("its event `{}` was dropped: it is a cyclic task", task.event));
      task.event.clear();
    } else if (kind == "2" && !task.interval.empty()) {
      change("its interval was dropped: it is a freewheeling task");
      task.interval.clear();
    } else if (!task.event.empty() && !task.interval.empty()) {
      change("it has an event and an interval: its cycle starts at both");
    }
    if (info_.size() > 1 && info_[1] != "0")
      model_.leftOut.push_back(
          {task.origin, "task " + task.name,
           fmt::format(
               "Additional_info has {} as its second field, probably a watchdog; if so, set "
               "`watchdog` in stride.toml",
               info_[1])});
    info_.clear();
  }

  /// `{event_task : 'start','what it is','handler','its declaration'}{event_task_info : …}`
  void systemEvent(std::string_view line) {
    std::array<std::string, 3> texts;
    size_t count = 0;
    bool inside = false;
    for (size_t i = 0; i < line.size() && count < texts.size(); ++i) {
      if (line[i] == '$' && inside)
        ++i;
      else if (line[i] == '\'')
        count += inside ? 1 : 0, inside = !inside;
      else if (inside)
        texts[count] += line[i];
    }
    if (!texts[2].empty())
      model_.leftOut.push_back({here(), fmt::format("system event {}", texts[0]),
                                fmt::format("it calls {}; Stride has no system events", texts[2])});
  }

  const std::vector<std::string> &lines_;
  const Origin &origin_;
  Model &model_;
  size_t at_ = 0;
  bool inTask_ = false;
  std::vector<std::string> info_;
};

} // namespace

void readExpTasks(const std::vector<std::string> &lines, const Origin &origin, Model &model) {
  Resource(lines, origin, model).read();
}

} // namespace stc::import
