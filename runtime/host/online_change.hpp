// A new build takes over from a running one, between two cycles.
#ifndef STRIDE_RUNTIME_HOST_ONLINE_CHANGE_HPP
#define STRIDE_RUNTIME_HOST_ONLINE_CHANGE_HPP

#include "runtime/app/carry_over.hpp"
#include "runtime/host/instance.hpp"

#include <memory>
#include <string>

namespace stride::host {

/// Loads, initialises and compares while the old build goes on running; then, in one short step,
/// takes its place. See docs/online-change.md.
class OnlineChange {
public:
  /// Throws app::Error: the file is no application, an initialiser fails.
  OnlineChange(Instance &instance, const std::string &path);

  /// Whether it can take over, with or without losses.
  app::Verdict verdict() const { return verdict_; }
  /// The new build, before apply.
  const StrideAppV1 &fresh() const { return fresh_->description(); }
  /// Why not, or what is lost; `all`: everything that differs.
  std::string report(bool all) const;

  /// The change itself, between two cycles, from a thread with a MemoryGuard. An exception in
  /// FB_Exit leaves the old build in force (but some of its instances have left); one in FB_Reinit
  /// stops the new one. False: it was FB_Exit. Not with Verdict::Refused.
  bool apply(int64_t timeNs);

  /// What differs but is not taken over by a running application.
  const std::vector<std::string> &atNextStart() const { return plan_->report().atNextStart(); }

  /// What only the values showed: addresses that became 0, texts that were cut.
  std::vector<std::string> events() const;

private:
  void compareTasks();

  Instance *instance_;
  std::unique_ptr<app::Application> fresh_; ///< The new build; after apply the old one.
  std::unique_ptr<app::CarryOver> plan_;
  app::CarryResult result_;
  app::Verdict verdict_;
  std::vector<std::string> refusals_; ///< Besides those of the plan.
  std::vector<std::string> events_;
};

} // namespace stride::host

#endif
