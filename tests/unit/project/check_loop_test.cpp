// A check leaves nothing in its process, whatever it has found.
#include "compiler/project/library_index.hpp"
#include "compiler/project/project.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <malloc.h>
#include <new>

namespace {

/// What `new` has given away and not got back.
struct {
  size_t objects = 0;
  size_t bytes = 0;
} alive;

} // namespace

void *operator new(size_t size) {
  void *memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr)
    throw std::bad_alloc();
  ++alive.objects;
  alive.bytes += malloc_usable_size(memory);
  return memory;
}

void *operator new(size_t size, const std::nothrow_t & /*tag*/) noexcept {
  try {
    return operator new(size);
  } catch (const std::bad_alloc &) {
    return nullptr;
  }
}

void operator delete(void *memory) noexcept {
  if (memory == nullptr)
    return;
  --alive.objects;
  alive.bytes -= malloc_usable_size(memory);
  std::free(memory);
}

void operator delete(void *memory, size_t /*size*/) noexcept { operator delete(memory); }

namespace stc {
namespace {

namespace fs = std::filesystem;

constexpr const char *kConfiguration = R"toml([[task]]
name = "T"
interval = "T#4ms"
programs = ["Main"]
[[task]]
name = "E"
kind = "event"
event = "gEdge"
programs = ["Edge"]
[[bus]]
name = "Bus"
InterfaceType = "Dummy (simulated drives)"
[[bus.axis_group]]
name = "Group"
sTask = "T"
[[bus.axis_group.drive]]
name = "Drive"
wDriveId = 1
)toml";

#ifdef __SANITIZE_ADDRESS__ // where each takes ten times as long
constexpr int kChecks = 100;
#else
constexpr int kChecks = 1000;
#endif

/// A program of its own for each number; every third is wrong.
std::string program(int number) {
  return "PROGRAM Main\nVAR n" + std::to_string(number) +
         " : INT; m : MC_MoveAbsolute; END_VAR\nn" + std::to_string(number) +
         " := " + (number % 3 == 0 ? "gone" : "7") +
         ";\nm(Axis := Drive, Execute := TRUE);\nEND_PROGRAM\n";
}

TEST(CheckLoop, AThousandChecksLeaveNothing) {
  const EmbeddedLibraryIndex index(standardLibrary());
  const fs::path folder = fs::temp_directory_path(); // nothing is read from it
  Overlay overlay;
  const fs::path file = folder / "stride_check_loop" / "Main.st";
  fs::create_directories(file.parent_path());
  overlay.set(file.parent_path() / "stride.toml", kConfiguration);
  overlay.set(file.parent_path() / "Globals.st",
              "VAR_GLOBAL gEdge : BOOL; END_VAR\nPROGRAM Edge\nEND_PROGRAM\n");
  overlay.set(file.parent_path() / "Lift.cam.toml",
              "[master]\nstart = 0\nend = 360\n[[point]]\nx = 0\ny = 0\n[[point]]\nx = 90\n"
              "y = 20\n[[point]]\nx = 360\ny = 0\n");
  const auto once = [&](int number) {
    overlay.set(file, program(number));
    const Project project(file.parent_path(), Purpose::Check, {}, index, &overlay);
    ASSERT_EQ(project.diagnostics().empty(), number % 3 != 0) << number;
  };
  once(1000); // whatever is made once, is made now
  once(1002);
  const auto before = alive;
  for (int number = 1003; number < 1003 + kChecks; ++number)
    once(number);
  once(1002); // the overlay holds as much as before
  EXPECT_EQ(alive.objects, before.objects);
  EXPECT_EQ(alive.bytes, before.bytes);
  fs::remove_all(file.parent_path());
}

} // namespace
} // namespace stc
