#include "runtime/monitor/service.hpp"

#include "runtime/app/error.hpp"
#include "runtime/app/nearest.hpp"
#include "runtime/monitor/request_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace stride::monitor {

namespace {

using nlohmann::json;

constexpr const char *kOperations[] = {
    "read",         "write",       "force",       "unforce",    "forces", "list",
    "subscribe",    "unsubscribe", "tasks",       "statistics", "state",  "record",
    "record_state", "record_read", "record_stop", "stop",       "start"};

std::string lineOf(const json &message) {
  return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

} // namespace

/// A client that cannot be told what it waits for must not wait for it.
template <class F> void Service::orGiveUp(ClientId client, const F &work) const noexcept {
  try {
    work();
  } catch (const std::exception &) {
    giveUp_(client);
  }
}

void Service::addOperation(const std::string &name, Operation operation) {
  const std::lock_guard lock(mutex_);
  operations_[name] = std::move(operation);
}

void Service::addLateOperation(const std::string &name, LateOperation operation) {
  const std::lock_guard lock(mutex_);
  lateOperations_[name] = std::move(operation);
}

void Service::answerLate(const Ticket &ticket, json result) {
  const std::lock_guard lock(mutex_);
  if (const auto waiting = late_.find(ticket.client); waiting != late_.end()) {
    --waiting->second;
    answer(ticket.client, ticket.id, std::move(result));
  }
}

void Service::refuseLate(const Ticket &ticket, const ServiceError &error) {
  const std::lock_guard lock(mutex_);
  if (const auto waiting = late_.find(ticket.client); waiting != late_.end()) {
    --waiting->second;
    refuse(ticket.client, ticket.id, error);
  }
}

void Service::attach(size_t number, ServedApplication application) {
  const std::lock_guard lock(mutex_);
  applications_.resize(std::max(applications_.size(), number + 1));
  applications_[number] = std::move(application);
}

void Service::detach(size_t number) noexcept {
  const std::lock_guard lock(mutex_);
  if (number >= applications_.size())
    return;
  std::erase_if(pending_, [&](const Pending &pending) {
    if (pending.application != number)
      return false;
    orGiveUp(pending.client, [&] {
      refuse(pending.client, pending.id, {"gone", "the application does not run any more"});
    });
    return true;
  });
  std::erase_if(subscriptions_, [&](const Subscription &subscription) {
    if (subscription.application != number)
      return false;
    orGiveUp(subscription.client, [&] {
      send_(subscription.client,
            lineOf({{"event", "ended"}, {"subscription", subscription.number}}));
    });
    return true;
  });
  try {
    last_.resize(applications_.size());
    if (applications_[number].symbols != nullptr) {
      last_[number] = stateOf(applications_[number]);
      last_[number]["state"] = "stopped";
    }
  } catch (const std::exception &) { // nothing is known of it then
  }
  applications_[number].symbols = nullptr;
  applications_[number].tasks = nullptr;
}

std::string Service::hello() const {
  const std::lock_guard lock(mutex_);
  json names = json::array();
  for (const ServedApplication &application : applications_)
    names.push_back(application.name);
  return lineOf({{"hello", "stride"}, {"version", kVersion}, {"applications", names}});
}

void Service::handle(ClientId client, std::string_view line) noexcept {
  const std::lock_guard lock(mutex_);
  orGiveUp(client, [&] { handleHere(client, line); });
}

void Service::handleHere(ClientId client, std::string_view line) {
  json id;
  try {
    const json request = parseRequest(line);
    id = requestId(request);
    dispatch(client, id, request);
  } catch (const ServiceError &error) {
    refuse(client, id, error);
  } catch (const app::Error &error) {
    refuse(client, id, {"refused", error.what()});
  } catch (const std::bad_alloc &) {
    refuse(client, id, {"refused", "there is not enough memory for that"});
  }
}

void Service::dispatch(ClientId client, const json &id, const json &request) {
  const std::string op = textField(request, "op");
  checkPending(client);
  const auto added = operations_.find(op);
  const auto late = lateOperations_.find(op);
  if (added != operations_.end())
    answer(client, id, added->second(request));
  else if (late != lateOperations_.end()) {
    late->second({client, id}, request);
    ++late_[client];
  } else if (op == "read")
    read(client, id, request);
  else if (op == "write")
    write(client, id, request);
  else if (op == "force")
    force(client, id, request);
  else if (op == "unforce")
    unforce(client, id, request);
  else if (op == "forces")
    answer(client, id, forces(request));
  else if (op == "list")
    answer(client, id, list(request));
  else if (op == "subscribe")
    subscribe(client, id, request);
  else if (op == "unsubscribe")
    answer(client, id, unsubscribe(client, request));
  else if (op == "tasks" || op == "statistics")
    answer(client, id, tasks(request, op == "statistics"));
  else if (op == "state")
    answer(client, id, state(request));
  else if (op == "stop")
    setMode(client, id, request, task::OperatingMode::Stop);
  else if (op == "start")
    setMode(client, id, request, task::OperatingMode::Run);
  else if (op == "record")
    answer(client, id, record(request));
  else if (op == "record_state")
    answer(client, id, recordState(request));
  else if (op == "record_read")
    answer(client, id, recordRead(request));
  else if (op == "record_stop")
    answer(client, id, recordStop(request));
  else {
    std::vector<std::string> known(std::begin(kOperations), std::end(kOperations));
    for (const auto &[name, operation] : operations_)
      known.push_back(name);
    for (const auto &[name, operation] : lateOperations_)
      known.push_back(name);
    throw ServiceError{"unknown_op",
                       fmt::format("there is no operation '{}'{}", op, app::didYouMean(op, known))};
  }
}

void Service::answer(ClientId client, const json &id, json result) {
  send_(client, lineOf({{"id", id}, {"result", std::move(result)}}));
}

void Service::refuse(ClientId client, const json &id, const ServiceError &error) {
  send_(client,
        lineOf({{"id", id}, {"error", {{"code", error.code}, {"message", error.message}}}}));
}

size_t Service::applicationOf(const json &request) const {
  if (!request.contains("app"))
    return 0;
  const std::string name = textField(request, "app");
  std::vector<std::string> names;
  for (size_t i = 0; i < applications_.size(); ++i) {
    if (applications_[i].name == name)
      return i;
    names.push_back(applications_[i].name);
  }
  throw ServiceError{"unknown_app", fmt::format("there is no application '{}'{}", name,
                                                app::didYouMean(name, names))};
}

const ServedApplication &Service::running(size_t number) const {
  if (number >= applications_.size() || applications_[number].symbols == nullptr)
    throw ServiceError{"gone", "the application does not run at the moment"};
  return applications_[number];
}

void Service::wait(Pending pending) { pending_.push_back(std::move(pending)); }

void Service::checkPending(ClientId client) const {
  const auto mine = std::count_if(pending_.begin(), pending_.end(),
                                  [&](const Pending &p) { return p.client == client; });
  const auto late = late_.find(client);
  if (static_cast<size_t>(mine) + (late != late_.end() ? late->second : 0) >= kMostPending)
    throw ServiceError{"too_many", fmt::format("{} requests of this client are not answered yet; "
                                               "wait for answers",
                                               kMostPending)};
}

bool Service::busy(ClientId client) const noexcept {
  const std::lock_guard lock(mutex_);
  const auto mine = [client](const auto &one) { return one.client == client; };
  const auto late = late_.find(client);
  return std::any_of(pending_.begin(), pending_.end(), mine) ||
         std::any_of(subscriptions_.begin(), subscriptions_.end(), mine) ||
         (late != late_.end() && late->second != 0);
}

void Service::forget(ClientId client) noexcept {
  const std::lock_guard lock(mutex_);
  late_.erase(client);
  std::erase_if(pending_, [&](const Pending &pending) { return pending.client == client; });
  std::erase_if(subscriptions_,
                [&](const Subscription &subscription) { return subscription.client == client; });
}

void Service::poll(int64_t nowNs) noexcept {
  const std::lock_guard lock(mutex_);
  pollPending(nowNs);
  pollSubscriptions(nowNs);
}

int64_t Service::idleNs(int64_t nowNs) const {
  static constexpr int64_t kWhileWaitingNs = 1'000'000;
  static constexpr int64_t kLongestNs = 200'000'000;
  const std::lock_guard lock(mutex_);
  int64_t idle = pending_.empty() ? kLongestNs : kWhileWaitingNs;
  for (const Subscription &subscription : subscriptions_)
    idle = std::min(idle, subscription.asked ? kWhileWaitingNs
                                             : std::max<int64_t>(subscription.nextNs - nowNs, 0));
  return idle;
}

void Service::pollPending(int64_t nowNs) noexcept {
  std::erase_if(pending_, [&](Pending &pending) {
    if (pending.untilNs == 0)
      pending.untilNs = nowNs + kTimeoutNs;
    const ServedApplication &application = applications_[pending.application];
    const bool done = pending.request    ? pending.request->done()
                      : pending.setsMode ? application.tasks->modeTaken()
                                         : application.symbols->forcesTaken();
    if (!done && nowNs < pending.untilNs)
      return false;
    orGiveUp(pending.client, [&] { conclude(application, pending, done); });
    return true;
  });
}

/// Answers a request that is done, or that nobody has done in time.
void Service::conclude(const ServedApplication &application, const Pending &pending, bool done) {
  if (!done) {
    refuse(pending.client, pending.id,
           {"timeout", fmt::format("no cycle has done it within {} s; does the task run?",
                                   kTimeoutNs / 1'000'000'000)});
    return;
  }
  if (pending.setsMode) {
    answer(pending.client, pending.id, stateOf(application));
    return;
  }
  if (!pending.request) {
    answer(pending.client, pending.id, json::object());
    return;
  }
  if (!application.symbols->valid(*pending.request)) {
    refuse(pending.client, pending.id,
           {"gone", "the application was changed before a cycle has done it; ask again"});
    return;
  }
  if (!pending.writes) {
    answer(pending.client, pending.id,
           valuesOf(application, *pending.request, pending.literals, true));
    return;
  }
  std::vector<std::string> missed;
  for (const SymbolRequest::Value &value : pending.request->values())
    if (!value.reached)
      missed.push_back("'" + value.symbol.path() + "'");
  if (missed.empty())
    answer(pending.client, pending.id, {{"time", secondsOf(pending.request->timeNs())}});
  else
    refuse(pending.client, pending.id,
           {"unreachable",
            fmt::format("not written: {}; a pointer on the way is null", fmt::join(missed, ", "))});
}

void Service::pollSubscriptions(int64_t nowNs) noexcept {
  std::erase_if(subscriptions_, [&](Subscription &subscription) {
    bool ended = true;
    orGiveUp(subscription.client, [&] { ended = !serve(subscription, nowNs); });
    return ended;
  });
}

/// Sends what is there and asks for the next values when it is time. False: it has ended.
bool Service::serve(Subscription &subscription, int64_t nowNs) {
  SymbolServer &server = *applications_[subscription.application].symbols;
  if (subscription.asked && subscription.request->done()) {
    subscription.asked = false;
    if (subscription.nextNs == 0)
      subscription.nextNs = nowNs + subscription.periodNs;
    if (server.valid(*subscription.request)) {
      json event = valuesOf(applications_[subscription.application], *subscription.request,
                            subscription.literals, false);
      event["event"] = "values";
      event["subscription"] = subscription.number;
      send_(subscription.client, lineOf(event));
    }
  }
  if (subscription.asked || nowNs < subscription.nextNs)
    return true;
  try {
    server.again(subscription.request);
  } catch (const app::Error &error) {
    send_(subscription.client, lineOf({{"event", "ended"},
                                       {"subscription", subscription.number},
                                       {"message", error.what()}}));
    return false;
  }
  subscription.asked = true;
  subscription.nextNs = std::max(subscription.nextNs + subscription.periodNs, nowNs);
  return true;
}

} // namespace stride::monitor
