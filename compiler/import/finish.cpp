#include "compiler/import/finish.hpp"

#include "compiler/import/addresses.hpp"
#include "compiler/import/dialect.hpp"
#include "compiler/import/drawn_bodies.hpp"
#include "compiler/import/names.hpp"
#include "compiler/import/plc_configuration.hpp"
#include "compiler/source/read_source.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

namespace stc::import {

namespace {

/// A library has no programs, and nothing of the machine.
void keepWhatLibrariesHave(Model &model) {
  const auto leaveOut = [&](const Origin &origin, std::string object, std::string why) {
    model.leftOut.push_back({origin, std::move(object), std::move(why)});
  };
  for (const Object &object : model.objects)
    if (isProgram(object))
      leaveOut(object.origin, "PROGRAM " + object.name, "a library cannot have programs");
  std::erase_if(model.objects, isProgram);
  for (const Task &task : model.tasks)
    leaveOut(task.origin, "task " + task.name, "a library has no tasks");
  for (const BusSetup &bus : model.buses)
    leaveOut(bus.origin, "bus " + bus.name, "a library has no drives");
  for (const IoChannel &channel : model.channels)
    leaveOut(channel.origin, "channel " + channel.name, "a library has no inputs and outputs");
  model.tasks.clear();
  model.buses.clear();
  model.channels.clear();
}

/// stride.toml wants something to call.
void dropIdleTasks(Model &model) {
  for (const Task &task : model.tasks)
    if (task.programs.empty())
      model.changed.push_back(
          {task.origin, "task " + task.name, "dropped: it calls no program of this import"});
  std::erase_if(model.tasks, [](const Task &task) { return task.programs.empty(); });
}

} // namespace

std::string finish(Model &model, const FinishSettings &settings) {
  std::optional<std::string> configuration = std::string();
  if (!settings.configuration.empty())
    configuration = readSource(settings.configuration);
  if (!configuration)
    return fmt::format("`{}` cannot be read: {}", settings.configuration, readSourceError());
  translateDrawnBodies(model, settings.libraryTexts);
  takeOnce(model);
  dropIdleTasks(model);
  if (settings.library)
    keepWhatLibrariesHave(model);
  nameParameters(model, *configuration);
  settleAddressing(model, settings.addressing);
  moveAddresses(model);
  settleDialect(model);
  renameReserved(model);
  lookUpLibraries(model, settings.own);
  return {};
}

} // namespace stc::import
