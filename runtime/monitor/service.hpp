// The requests of the monitor's protocol (docs/monitor.md), whatever carries them.
#ifndef STRIDE_RUNTIME_MONITOR_SERVICE_HPP
#define STRIDE_RUNTIME_MONITOR_SERVICE_HPP

#include "runtime/monitor/symbol_server.hpp"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace stride::monitor {

/// A running application. Everything outlives its being attached.
struct ServedApplication {
  std::string name;
  SymbolServer *symbols = nullptr; ///< null: it does not run at the moment
  task::TaskSet *tasks = nullptr;
  std::function<int64_t()> nowNs; ///< The program's time.
};

/// Something that cannot be done, as it is told to a client.
struct ServiceError {
  const char *code; ///< docs/monitor.md lists them.
  std::string message;
};

/// Takes requests, one JSON object a line, and gives answers and events, one a line. Functions may
/// be called from any thread; answers come from within handle() and poll().
class Service {
public:
  static constexpr int kVersion = 2;
  static constexpr size_t kMostSubscriptions = 16; ///< Per client.
  static constexpr size_t kMostPending = 32;       ///< Per client, unanswered.
  static constexpr int64_t kShortestPeriodNs = 10'000'000;
  static constexpr int64_t kTimeoutNs = 5'000'000'000;

  using ClientId = uint64_t;
  /// Gives a client a line, without the line's end.
  using Send = std::function<void(ClientId, const std::string &line)>;
  /// An operation that whoever runs the applications adds: its request to its result. Throws
  /// ServiceError or app::Error.
  using Operation = std::function<nlohmann::json(const nlohmann::json &request)>;

  /// Who has asked, for an answer that comes later.
  struct Ticket {
    ClientId client = 0;
    nlohmann::json id;
  };
  /// An operation that is answered with answerLate() or refuseLate(), from another thread.
  using LateOperation = std::function<void(Ticket, const nlohmann::json &request)>;

  /// A client that cannot be given its answer, for want of memory, is better hung up on.
  using GiveUp = std::function<void(ClientId)>;

  explicit Service(
      Send send, GiveUp giveUp = [](ClientId) {})
      : send_(std::move(send)), giveUp_(std::move(giveUp)) {}

  /// Before the first request.
  void addOperation(const std::string &name, Operation operation);
  void addLateOperation(const std::string &name, LateOperation operation);
  void answerLate(const Ticket &ticket, nlohmann::json result);
  void refuseLate(const Ticket &ticket, const ServiceError &error);
  /// Sets the application with that number, the next one or one that is there.
  void attach(size_t number, ServedApplication application);
  /// It does not run any more: what waits for it is answered with an error.
  void detach(size_t number) noexcept;

  /// While it is held no request is served: for a change of what is attached, or of the build.
  std::unique_lock<std::mutex> hold() const { return std::unique_lock(mutex_); }

  /// The first line for a client.
  std::string hello() const;
  void handle(ClientId client, std::string_view line) noexcept;
  /// The client waits for an answer or has subscribed to something.
  bool busy(ClientId client) const noexcept;
  /// The client has gone.
  void forget(ClientId client) noexcept;
  /// Answers what is done, sends what is due. `nowNs` is of the monotonic clock.
  void poll(int64_t nowNs) noexcept;
  /// How long poll() need not be called, if nothing comes in. [ns]
  int64_t idleNs(int64_t nowNs) const;

private:
  using Json = nlohmann::json;
  struct Pending {
    ClientId client;
    Json id;
    size_t application;
    std::shared_ptr<SymbolRequest> request; ///< null: waits for forces
    bool writes = false;
    bool literals = false;
    int64_t untilNs = 0;   ///< 0: not set yet
    bool setsMode = false; ///< Waits until all tasks have taken RUN or STOP over.
  };
  struct Subscription {
    ClientId client;
    uint64_t number;
    size_t application;
    std::shared_ptr<SymbolRequest> request;
    int64_t periodNs;
    int64_t nextNs = 0;
    bool asked = true; ///< The request is on its way.
    bool literals = false;
  };

  template <class F> void orGiveUp(ClientId client, const F &work) const noexcept;
  void handleHere(ClientId client, std::string_view line);
  void conclude(const ServedApplication &application, const Pending &pending, bool done);
  bool serve(Subscription &subscription, int64_t nowNs);
  void dispatch(ClientId client, const Json &id, const Json &request);
  void answer(ClientId client, const Json &id, Json result);
  void refuse(ClientId client, const Json &id, const ServiceError &error);
  size_t applicationOf(const Json &request) const;
  const ServedApplication &running(size_t number) const;
  void wait(Pending pending);
  void checkPending(ClientId client) const;

  void read(ClientId client, const Json &id, const Json &request);
  void write(ClientId client, const Json &id, const Json &request);
  void force(ClientId client, const Json &id, const Json &request);
  void unforce(ClientId client, const Json &id, const Json &request);
  void subscribe(ClientId client, const Json &id, const Json &request);
  Json unsubscribe(ClientId client, const Json &request);
  void setMode(ClientId client, const Json &id, const Json &request, task::OperatingMode mode);
  Json forces(const Json &request) const;
  Json list(const Json &request) const;
  Json tasks(const Json &request, bool figures) const;
  Json state(const Json &request) const;
  static Json stateOf(const ServedApplication &application);
  Json record(const Json &request);
  Json recordState(const Json &request) const;
  Json recordRead(const Json &request) const;
  Json recordStop(const Json &request);

  void pollPending(int64_t nowNs) noexcept;
  void pollSubscriptions(int64_t nowNs) noexcept;
  Json valuesOf(const ServedApplication &application, const SymbolRequest &request, bool literals,
                bool named) const;
  std::vector<NamedValue> namedValues(const ServedApplication &application,
                                      const Json &request) const;

  mutable std::mutex mutex_;
  Send send_;
  GiveUp giveUp_;
  std::map<std::string, Operation> operations_;
  std::map<std::string, LateOperation> lateOperations_;
  std::map<ClientId, size_t> late_; ///< How many late answers a client waits for.
  std::vector<ServedApplication> applications_;
  std::vector<Json> last_; ///< What op "state" says of applications that do not run any more.
  std::vector<Pending> pending_;
  std::vector<Subscription> subscriptions_;
  uint64_t lastSubscription_ = 0;
};

} // namespace stride::monitor

#endif
