// Operations on variables, and on what the runtime knows about the tasks.
#include "runtime/app/error.hpp"
#include "runtime/app/units.hpp"
#include "runtime/app/value_text.hpp"
#include "runtime/monitor/request_fields.hpp"
#include "runtime/monitor/symbol_list.hpp"
#include "runtime/monitor/value_json.hpp"
#include "runtime/task/task_kind.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace stride::monitor {

namespace {

using nlohmann::json;

constexpr size_t kMostListed = 1000;

json flagNames(uint32_t flags) {
  static constexpr std::pair<uint32_t, const char *> kNames[] = {
      {kSymInput, "input"},    {kSymOutput, "output"},         {kSymInOut, "in_out"},
      {kSymRetain, "retain"},  {kSymPersistent, "persistent"}, {kSymConstant, "constant"},
      {kSymLocated, "located"}};
  json names = json::array();
  for (const auto &[flag, name] : kNames)
    if ((flags & flag) != 0)
      names.push_back(name);
  return names;
}

json histogramJson(const task::Histogram &histogram, int64_t maximum) {
  return {{"p50", histogram.quantile(0.5)},
          {"p99", histogram.quantile(0.99)},
          {"p999", histogram.quantile(0.999)},
          {"max", maximum}};
}

} // namespace

/// Adds `unit` to what is told of a variable, where it is known.
static void addUnit(const StrideAppV1 &app, const std::string &path, json &to) {
  if (std::string unit = app::unitOf(app, path); !unit.empty())
    to["unit"] = std::move(unit);
}

json Service::valuesOf(const ServedApplication &application, const SymbolRequest &request,
                       bool literals, bool named) const {
  const app::SymbolTable &symbols = application.symbols->symbols();
  json values = json::array();
  for (const SymbolRequest::Value &value : request.values()) {
    const TypeDesc &type = symbols.type(value.symbol);
    json shown;
    if (value.reached && literals)
      shown = app::formatLiteral(symbols.app(), type, request.bytes(value));
    else if (value.reached)
      shown = valueToJson(symbols.app(), type, request.bytes(value));
    if (!named) {
      values.push_back(std::move(shown));
      continue;
    }
    values.push_back(
        {{"name", value.symbol.path()}, {"type", type.name}, {"value", std::move(shown)}});
    addUnit(symbols.app(), value.symbol.path(), values.back());
  }
  return {{"time", secondsOf(request.timeNs())}, {"values", std::move(values)}};
}

std::vector<NamedValue> Service::namedValues(const ServedApplication &application,
                                             const json &request) const {
  const auto values = request.find("values");
  if (values == request.end() || !values->is_array() || values->empty())
    throw ServiceError{"bad_request", "'values' is a list of {\"name\":…,\"value\":…} or "
                                      "{\"name\":…,\"literal\":…}"};
  if (values->size() > SymbolServer::kValuesPerRequest)
    throw ServiceError{"bad_request", "too many values at once"};
  std::vector<NamedValue> list;
  const app::SymbolTable &symbols = application.symbols->symbols();
  for (const json &entry : *values) {
    if (!entry.is_object())
      throw ServiceError{"bad_request", "an entry of 'values' is an object"};
    std::string name = textField(entry, "name");
    std::string literal;
    if (entry.contains("literal"))
      literal = textField(entry, "literal");
    else if (const auto value = entry.find("value"); value != entry.end())
      literal = literalOfJson(symbols.type(symbols.resolve(name)), *value);
    else
      throw ServiceError{"bad_request",
                         fmt::format("'{}' has neither 'value' nor 'literal'", name)};
    list.emplace_back(std::move(name), std::move(literal));
  }
  return list;
}

void Service::read(ClientId client, const json &id, const json &request) {
  const size_t number = applicationOf(request);
  const bool literals = flagField(request, "literals");
  wait(
      {client, id, number, running(number).symbols->read(namesField(request)), false, literals, 0});
}

void Service::write(ClientId client, const json &id, const json &request) {
  const size_t number = applicationOf(request);
  const ServedApplication &application = running(number);
  wait({client, id, number, application.symbols->write(namedValues(application, request)), true,
        false, 0});
}

void Service::force(ClientId client, const json &id, const json &request) {
  const size_t number = applicationOf(request);
  const ServedApplication &application = running(number);
  application.symbols->force(namedValues(application, request));
  wait({client, id, number, nullptr, false, false, 0});
}

void Service::unforce(ClientId client, const json &id, const json &request) {
  const size_t number = applicationOf(request);
  if (flagField(request, "all"))
    running(number).symbols->releaseAll();
  else
    running(number).symbols->release(namesField(request));
  wait({client, id, number, nullptr, false, false, 0});
}

json Service::forces(const json &request) const {
  json values = json::array();
  for (const auto &[name, literal] : running(applicationOf(request)).symbols->forced())
    values.push_back({{"name", name}, {"literal", literal}});
  return {{"values", std::move(values)}};
}

json Service::list(const json &request) const {
  const app::SymbolTable &symbols = running(applicationOf(request)).symbols->symbols();
  const SymbolPage page = listSymbols(symbols, textField(request, "path", ""),
                                      countField(request, "offset", 0, UINT64_MAX),
                                      countField(request, "limit", 200, kMostListed));
  json entries = json::array();
  for (const SymbolEntry &entry : page.entries)
    entries.push_back({{"name", entry.name},
                       {"path", entry.path},
                       {"type", entry.type},
                       {"flags", flagNames(entry.flags)},
                       {"value", app::isElementary(entry.kind)},
                       {"children", entry.children}});
  for (json &entry : entries)
    addUnit(symbols.app(), entry.at("path").get<std::string>(), entry);
  return {{"total", page.total}, {"entries", std::move(entries)}};
}

void Service::subscribe(ClientId client, const json &id, const json &request) {
  const size_t number = applicationOf(request);
  const ServedApplication &application = running(number);
  const auto mine = std::count_if(subscriptions_.begin(), subscriptions_.end(),
                                  [&](const Subscription &s) { return s.client == client; });
  if (static_cast<size_t>(mine) >= kMostSubscriptions)
    throw ServiceError{"too_many", fmt::format("a client has at most {} subscriptions; name more "
                                               "variables in one of them",
                                               kMostSubscriptions)};
  const double period = realField(request, "period", 0.1);
  if (period < secondsOf(kShortestPeriodNs) || period > 3600.0)
    throw ServiceError{"bad_request", fmt::format("'period' is from {} to 3600 seconds",
                                                  secondsOf(kShortestPeriodNs))};
  Subscription subscription{client, ++lastSubscription_, number,
                            application.symbols->read(namesField(request)),
                            static_cast<int64_t>(period * 1e9)};
  subscription.literals = flagField(request, "literals");
  json columns = json::array();
  for (const SymbolRequest::Value &value : subscription.request->values()) {
    columns.push_back({{"name", value.symbol.path()},
                       {"type", application.symbols->symbols().type(value.symbol).name}});
    addUnit(application.symbols->symbols().app(), value.symbol.path(), columns.back());
  }
  answer(client, id, {{"subscription", subscription.number}, {"columns", std::move(columns)}});
  subscriptions_.push_back(std::move(subscription));
}

json Service::unsubscribe(ClientId client, const json &request) {
  const uint64_t number = countField(request, "subscription", 0, UINT64_MAX);
  if (std::erase_if(subscriptions_, [&](const Subscription &subscription) {
        return subscription.client == client && subscription.number == number;
      }) == 0)
    throw ServiceError{"bad_request", fmt::format("there is no subscription {}", number)};
  return json::object();
}

json Service::tasks(const json &request, bool figures) const {
  const task::TaskSet &tasks = *running(applicationOf(request)).tasks;
  json list = json::array();
  for (uint32_t i = 0; i < tasks.count(); ++i) {
    const TaskDesc &desc = tasks.desc(i);
    json entry = {{"name", desc.name}};
    if (!figures) {
      entry["kind"] = task::kindName(desc.kind);
      entry["priority"] = desc.priority;
      entry["interval_ns"] = desc.intervalNs;
      entry["watchdog_ns"] = desc.watchdogNs;
    } else {
      const task::TaskStatistics &statistics = tasks.statistics(i);
      const task::TaskFigures now = statistics.figures();
      entry["cycles"] = now.cycles;
      entry["overruns"] = now.overruns;
      entry["watchdog_violations"] = now.watchdogViolations;
      entry["run_ns"] = histogramJson(statistics.runTimes(), now.maxRunNs);
      entry["run_ns"]["min"] = now.minRunNs;
      entry["run_ns"]["mean"] = now.meanRunNs();
      entry["run_ns"]["last"] = now.lastRunNs;
      entry["delay_ns"] = histogramJson(statistics.latencies(), now.maxLatencyNs);
      entry["interval_ns"] = {{"min", now.minIntervalNs}, {"max", now.maxIntervalNs}};
    }
    list.push_back(std::move(entry));
  }
  return {{"tasks", std::move(list)}};
}

json Service::state(const json &request) const {
  const size_t number = applicationOf(request);
  if (number < last_.size() && applications_[number].symbols == nullptr && !last_[number].is_null())
    return last_[number];
  return stateOf(running(number));
}

/// Answered when every task has taken it over, at once where it has been so before.
void Service::setMode(ClientId client, const json &id, const json &request,
                      task::OperatingMode mode) {
  const size_t number = applicationOf(request);
  task::TaskSet &tasks = *running(number).tasks;
  if (tasks.stopped())
    throw ServiceError{"gone", "the application is ending, or an exception has stopped it"};
  tasks.setMode(mode);
  wait({.client = client, .id = id, .application = number, .request = {}, .setsMode = true});
}

json Service::stateOf(const ServedApplication &application) {
  const StrideAppV1 &app = application.symbols->symbols().app();
  json result = {{"name", application.name},
                 {"build", fmt::format("{:016x}", app.buildHash)},
                 {"time", secondsOf(application.nowNs())},
                 {"state", application.tasks->stopped() ? "stopped" : "running"},
                 {"mode", task::nameOf(application.tasks->mode())}};
  if (const std::optional<task::Fault> fault = application.tasks->fault())
    result["fault"] = task::describe(*fault);
  return result;
}

} // namespace stride::monitor
