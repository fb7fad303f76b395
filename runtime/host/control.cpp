#include "runtime/host/control.hpp"

#include "runtime/app/error.hpp"
#include "runtime/host/exit_code.hpp"
#include "runtime/host/options.hpp"
#include "runtime/host/output.hpp"
#include "runtime/monitor/socket_client.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace stride::host {

namespace {

using monitor::SocketClient;
using nlohmann::json;

/// What cannot be printed shows in the exit code.
template <class... Values>
void put(std::FILE *to, fmt::format_string<Values...> format, Values &&...values) {
  const std::string text = shownOn(to, fmt::format(format, std::forward<Values>(values)...));
  std::fwrite(text.data(), 1, text.size(), to);
}

/// `NAME=VALUE` or `NAME:=VALUE` as an entry of `values`.
json namedLiteral(const std::string &text) {
  const size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos)
    throw app::Error(fmt::format("'{}' has not the form NAME=VALUE", text));
  const size_t end = text[equals - 1] == ':' ? equals - 1 : equals;
  return {{"name", text.substr(0, end)}, {"literal", text.substr(equals + 1)}};
}

json namedLiterals(const std::vector<std::string> &texts) {
  json values = json::array();
  for (const std::string &text : texts)
    values.push_back(namedLiteral(text));
  return values;
}

/// A number of seconds, or a duration.
double secondsOf(const std::string &text) {
  double seconds = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  if (error == std::errc() && end == text.data() + text.size())
    return seconds;
  return static_cast<double>(parseDuration(text, false)) * 1e-9;
}

/// " [mm]", or an empty text.
std::string unitOf(const json &about) {
  const auto unit = about.find("unit");
  return unit == about.end() ? std::string() : fmt::format(" [{}]", unit->get<std::string>());
}

std::string literalOf(const json &value) {
  return value.is_string() ? value.get<std::string>() : std::string("(pointer is null)");
}

void showValues(const json &result) {
  for (const json &value : result.at("values"))
    put(stdout, "{} = {}{}\n", value.at("name").get<std::string>(), literalOf(value.at("value")),
        unitOf(value));
}

double micro(const json &ns) { return ns.get<double>() * 1e-3; }

void showStatistics(const json &result) {
  put(stdout, "{:<16} {:>10} {:>8}  {:>28}  {:>28}\n", "task", "cycles", "overruns",
      "run time p50/p99/max [us]", "delay p50/p99/max [us]");
  for (const json &task : result.at("tasks")) {
    const json &run = task.at("run_ns");
    const json &delay = task.at("delay_ns");
    put(stdout, "{:<16} {:>10} {:>8}  {:>28}  {:>28}\n", task.at("name").get<std::string>(),
        task.at("cycles").get<uint64_t>(), task.at("overruns").get<uint64_t>(),
        fmt::format("{:.1f} / {:.1f} / {:.1f}", micro(run.at("p50")), micro(run.at("p99")),
                    micro(run.at("max"))),
        fmt::format("{:.1f} / {:.1f} / {:.1f}", micro(delay.at("p50")), micro(delay.at("p99")),
                    micro(delay.at("max"))));
  }
}

void showState(const json &state) {
  const bool inStop = state.at("state") == "running" && state.at("mode") == "STOP";
  put(stdout, "{}: {} at {:.3f} s\n", state.at("name").get<std::string>(),
      inStop ? std::string("in STOP") : state.at("state").get<std::string>(),
      state.at("time").get<double>());
  if (state.contains("fault"))
    put(stdout, "{}\n", state.at("fault").get<std::string>());
}

/// All pages of a list.
void showList(SocketClient &client, json request) {
  uint64_t shown = 0;
  for (;;) {
    request["offset"] = shown;
    const json page = client.ask(request);
    for (const json &entry : page.at("entries")) {
      const auto children = entry.at("children").get<uint64_t>();
      put(stdout, "{} : {}{}{}\n", entry.at("path").get<std::string>(),
          entry.at("type").get<std::string>(), unitOf(entry),
          children == 0 ? std::string() : fmt::format(" ({})", children));
    }
    shown += page.at("entries").size();
    if (page.at("entries").empty() || shown >= page.at("total").get<uint64_t>())
      return;
  }
}

/// Throws app::Error when it was refused.
void showChange(const json &result) {
  const json &applications = result.at("applications");
  bool done = true;
  for (const json &one : applications) {
    const bool good = one.at("result") == "done";
    done = done && good;
    for (const json &line : one.at("report"))
      put(good ? stdout : stderr, "{}{}\n",
          applications.size() > 1 ? one.at("name").get<std::string>() + ": " : std::string(),
          line.get<std::string>());
  }
  if (!done)
    throw app::Error("the online change was refused");
}

} // namespace

struct Control::Impl {
  std::string address;
  std::string application;
  std::vector<std::string> texts;
  std::string text;
  std::string period = "0.5";
  uint64_t count = 0;
  bool all = false;
  bool acceptLosses = false;
  std::string trigger;
  std::string edge = "rising";
  std::string threshold;
  std::string out;
  uint64_t rows = 1000;
  double before = 0.0;
  std::function<void(SocketClient &)> action;

  CLI::App *add(CLI::App &command, const char *name, const char *help,
                std::function<void(SocketClient &)> what) {
    CLI::App *sub = command.add_subcommand(name, help);
    sub->callback([this, what = std::move(what)] { action = what; });
    return sub;
  }
  void names(CLI::App *sub, const char *type) {
    sub->add_option("NAMES", texts, "Variables")->required()->type_name(type);
  }
  json request(const char *op) const {
    json result = {{"op", op}};
    if (!application.empty())
      result["app"] = application;
    return result;
  }
  json withNames(const char *op) const {
    json result = request(op);
    result["names"] = texts;
    return result;
  }
  json withValues(const char *op) const {
    json result = request(op);
    result["values"] = namedLiterals(texts);
    return result;
  }

  void read(SocketClient &client) const {
    json question = withNames("read");
    question["literals"] = true;
    showValues(client.ask(question));
  }
  void unforce(SocketClient &client) const {
    if (all == !texts.empty())
      throw app::Error("name the variables to release, or say --all");
    json question = all ? request("unforce") : withNames("unforce");
    if (all)
      question["all"] = true;
    client.ask(question);
  }
  void watch(SocketClient &client) const;
  void recordRows(SocketClient &client) const;

  // In the order of the help.
  void declareValues(CLI::App &command);
  void declareRecordings(CLI::App &command);
  void declareRun(CLI::App &command);
};

void Control::Impl::watch(SocketClient &client) const {
  json question = withNames("subscribe");
  question["period"] = secondsOf(period);
  question["literals"] = true;
  const json subscription = client.ask(question);
  std::string header = "t";
  for (const json &column : subscription.at("columns"))
    header += "\t" + column.at("name").get<std::string>() + unitOf(column);
  put(stdout, "{}\n", header);
  for (uint64_t seen = 0; count == 0 || seen < count; ++seen) {
    json event = client.receive();
    while (!event.contains("event"))
      event = client.receive();
    if (event.at("event") != "values")
      throw app::Error(event.value("message", "the application does not run any more"));
    std::string line = fmt::format("{:.6f}", event.at("time").get<double>());
    for (const json &value : event.at("values"))
      line += "\t" + literalOf(value);
    put(stdout, "{}\n", line);
    if (std::fflush(stdout) != 0)
      return; // nobody watches any more
  }
}

void Control::Impl::recordRows(SocketClient &client) const {
  json question = withNames("record");
  question["rows"] = rows;
  question["before"] = before;
  if (!trigger.empty()) {
    question["trigger"] = {{"name", trigger}, {"edge", edge}};
    if (!threshold.empty())
      question["trigger"]["threshold"] = threshold;
  }
  client.ask(question);
  json state = client.ask(request("record_state"));
  for (; state.at("state") != "done"; state = client.ask(request("record_state")))
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  if (state.contains("ended_by"))
    put(stderr, "warning: the recording ended at an online change: {}\n",
        state.at("ended_by").get<std::string>());
  std::ofstream file;
  if (!out.empty() && out != "-") {
    file.open(out, std::ios::binary);
    if (!file)
      throw app::Error(fmt::format("cannot write '{}'", out));
  }
  std::ostream &to = file.is_open() ? static_cast<std::ostream &>(file) : std::cout;
  const auto shown = [&](const json &line) {
    return file.is_open() ? line.get<std::string>() : shownOn(stdout, line.get<std::string>());
  };
  for (uint64_t row = 0;;) {
    json next = request("record_read");
    next["from"] = row;
    const json page = client.ask(next);
    if (row == 0)
      to << shown(page.at("header")) << '\n';
    for (const json &line : page.at("lines"))
      to << shown(line) << '\n';
    row += page.at("lines").size();
    if (page.at("lines").empty() || row >= page.at("rows").get<uint64_t>())
      break;
  }
  if (!to.flush())
    throw app::Error(fmt::format("cannot write '{}'", out));
}

Control::Control() : impl_(std::make_unique<Impl>()) {}
Control::~Control() = default;

/// Values of variables, once.
void Control::Impl::declareValues(CLI::App &command) {
  names(add(command, "read", "Show values", [this](SocketClient &client) { read(client); }),
        "NAME...");
  names(add(command, "write", "Write values once",
            [this](SocketClient &client) { client.ask(withValues("write")); }),
        "NAME=VALUE...");
  names(add(command, "force", "Keep values, whatever the program writes",
            [this](SocketClient &client) { client.ask(withValues("force")); }),
        "NAME=VALUE...");
  CLI::App *release = add(command, "unforce", "Release forced variables",
                          [this](SocketClient &client) { unforce(client); });
  release->add_option("NAMES", texts, "Variables")->type_name("NAME...");
  release->add_flag("--all", all, "All of them");
  add(command, "forces", "Show what is forced", [this](SocketClient &client) {
    const json forced = client.ask(request("forces"));
    for (const json &value : forced.at("values"))
      put(stdout, "{} = {}\n", value.at("name").get<std::string>(), literalOf(value.at("literal")));
  });
  add(command, "list", "Show the names below a name",
      [this](SocketClient &client) {
        json question = request("list");
        question["path"] = text;
        showList(client, question);
      })
      ->add_option("NAME", text, "Without it: programs and global variables")
      ->type_name("NAME");
}

/// Values over time.
void Control::Impl::declareRecordings(CLI::App &command) {
  CLI::App *lines = add(command, "watch", "Show values again and again",
                        [this](SocketClient &client) { watch(client); });
  names(lines, "NAME...");
  lines->add_option("--period", period, "Between two lines: 200ms, T#1s, or seconds as a number")
      ->capture_default_str()
      ->type_name("TIME");
  lines->add_option("--count", count, "Lines; until Ctrl-C without it");
  CLI::App *record = add(command, "record", "Record values in every cycle, as CSV",
                         [this](SocketClient &client) { recordRows(client); });
  names(record, "NAME...");
  record->add_option("--rows", rows, "Rows of the recording")->capture_default_str();
  record->add_option("--before", before, "Share of the rows before the trigger, 0 to 1")
      ->capture_default_str();
  record->add_option("--trigger", trigger, "Variable that the recording waits for")
      ->type_name("NAME");
  record->add_option("--edge", edge, "rising, falling, high, low")->capture_default_str();
  record->add_option("--threshold", threshold, "Where the trigger's edge is, if not a BOOL")
      ->type_name("VALUE");
  record->add_option("--out", out, "File (CSV); standard output without it")->type_name("FILE");
}

/// What concerns the application as a whole.
void Control::Impl::declareRun(CLI::App &command) {
  add(command, "stats", "Show the figures of the tasks",
      [this](SocketClient &client) { showStatistics(client.ask(request("statistics"))); });
  add(command, "state", "Show what the application is doing",
      [this](SocketClient &client) { showState(client.ask(request("state"))); });
  add(command, "change", "Take new builds of the applications over (online change)",
      [this](SocketClient &client) {
        json question = request("online_change");
        if (acceptLosses)
          question["accept_losses"] = true;
        showChange(client.ask(question));
      })
      ->add_flag("--accept-losses", acceptLosses, "Also when values of variables get lost");
  add(command, "stop",
      "Put the PLC into STOP: no POU runs, drives, inputs and this go on; outputs as `on_stop` "
      "says",
      [this](SocketClient &client) { showState(client.ask(request("stop"))); });
  add(command, "start", "Put the PLC back to RUN, with the values that the variables have",
      [this](SocketClient &client) { showState(client.ask(request("start"))); });
  add(command, "end", "End the run", [this](SocketClient &client) { client.ask(request("end")); });
}

void Control::declare(CLI::App &command) {
  command
      .add_option("ADDRESS", impl_->address,
                  "What the run was given as --listen: unix:PATH. `stride ctl` also takes a "
                  "project's folder; without both the project of the current folder is meant")
      ->type_name("unix:PATH");
  command.add_option("--app", impl_->application, "Which application (default: the first one)")
      ->type_name("NAME");
  command.require_subcommand(1);
  impl_->declareValues(command);
  impl_->declareRecordings(command);
  impl_->declareRun(command);
}

int Control::run() {
  if (impl_->address.empty())
    throw app::Error("name the socket that the run listens at: unix:PATH");
  SocketClient client(impl_->address);
  impl_->action(client);
  return kExitOk;
}

} // namespace stride::host
