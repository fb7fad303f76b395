// A loaded application: its description, its state, and the way to both.
#ifndef STRIDE_RUNTIME_APP_APPLICATION_HPP
#define STRIDE_RUNTIME_APP_APPLICATION_HPP

#include "runtime/app/abi.h"
#include "runtime/app/state_block.hpp"
#include "runtime/app/symbol_text.hpp"

#include <functional>
#include <memory>
#include <string>

namespace stride::app {

/// Layout hashes of the types that the runtime itself accesses; 0: not known, not compared.
struct RuntimeLayouts {
  uint64_t axisRef = 0;
  uint64_t axisGroupRef = 0;
  uint64_t encoderRef = 0;
};

/// One application object. Several can live in one process without meeting.
class Application {
public:
  /// Loads the shared object. Throws Error: file missing, not an application, another ABI version,
  /// other layouts than `layouts`, damaged tables.
  static Application load(const std::string &path, const RuntimeLayouts &layouts = {});

  /// An application linked into this program. Throws Error as load does.
  static Application fromDescription(const StrideAppV1 &description,
                                     const RuntimeLayouts &layouts = {});

  /// Zeroes the state and sets the defaults. `inCopyCode`: it will take over the values of a
  /// running application (carry_over.hpp); FB_Init is told. `keepRetains`: retained values will be
  /// put back (retain_image.hpp); FB_Init is told. Throws StException when an initialiser fails.
  /// `call` calls init with the context, and may guard it.
  using InitCall = std::function<void(void (*init)(Ctx *), Ctx &ctx)>;
  void initialise(
      const HostApi &host, bool inCopyCode = false, bool keepRetains = false,
      const InitCall &call = [](void (*init)(Ctx *), Ctx &ctx) { init(&ctx); });

  /// Values were put into the state after initialise(): the tasks are to see them.
  void settle();

  /// With all its tables; stays where it is as long as the application is there.
  const StrideAppV1 &description() const { return described_->description(); }
  /// As its project calls it. A project without a name of its own leaves it to whoever loads the
  /// application; until then it is that of the file.
  const std::string &name() const { return name_; }
  /// For one that carries no name.
  void setDefaultName(const std::string &name);
  std::byte *state() const { return state_.data(); }
  const StateBlock &stateBlock() const { return state_; }

private:
  struct Closer {
    void operator()(void *library) const;
  };

  explicit Application(std::unique_ptr<const DescribedApplication> described);

  static std::unique_ptr<const DescribedApplication> checked(const StrideAppV1 &description,
                                                             const RuntimeLayouts &layouts);

  std::unique_ptr<void, Closer> library_; // closed after everything else is gone
  std::unique_ptr<const DescribedApplication> described_;
  std::string name_;
  StateBlock state_;
};

} // namespace stride::app

#endif
