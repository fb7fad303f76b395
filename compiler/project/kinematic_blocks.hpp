#ifndef STRIDE_COMPILER_PROJECT_KINEMATIC_BLOCKS_HPP
#define STRIDE_COMPILER_PROJECT_KINEMATIC_BLOCKS_HPP
// The blocks that [[axes_group]] names as kinematics, and values for their inputs.

#include "compiler/project/config.hpp"
#include "compiler/project/type_finder.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stc {

// The interfaces of kinematics.
inline constexpr std::string_view kAnyKinematics = "MC_KIN_REF_SM3";
inline constexpr std::string_view kPlacingKinematics = "ISMPositionKinematics";
inline constexpr std::string_view kTurningKinematics = "ISMOrientationKinematics";

/// Blocks of the project and of libraries.
class KinematicBlocks {
public:
  KinematicBlocks(Program &program, const std::vector<ast::File *> &files,
                  const LibraryIndex &index)
      : program_(program), files_(files), finder_(program, index) {}

  /// Reports what is wrong with a block that is to implement an interface, and with values for its
  /// inputs. `what` it is to be, for messages. How many axes it has; 0: that is not known.
  size_t check(const ConfigName &name, std::string_view interfaceName, std::string_view what,
               const std::vector<InputValue> &values);

  /// Whether a block is none of the library's, if it is a kinematics at all.
  static bool isOwn(const ConfigName &name);

  /// Adds the initial value of an instance, with the semicolon after it; what `check` has found
  /// nothing wrong with.
  void addValues(const std::vector<InputValue> &values, const ConfigName &blockName,
                 SyntheticSource &out);

private:
  /// The block of that name; null: there is none.
  const ast::PouDecl *blockOf(std::string_view name);
  /// Whether a block, or what it extends, implements an interface, itself or one that extends it.
  bool implements(const ast::PouDecl *pou, std::string_view interfaceName, int depth = 0);
  /// Whether a kinematics of the library is asked for that needs another one below it.
  bool turnsOnly(std::string_view interfaceName, std::string_view name);
  void reportUnknownKinematics(const ConfigName &name, const ast::PouDecl *block,
                               std::string_view interfaceName, std::string_view what);
  void checkInput(std::string_view blockName, const ast::PouDecl &block, const InputValue &value);
  /// An input by its name; the names of all are added.
  const ast::VarDecl *inputOf(const ast::PouDecl &block, std::string_view name,
                              std::vector<std::string_view> &known);

  Program &program_;
  const std::vector<ast::File *> &files_;
  TypeFinder finder_;
};

} // namespace stc

#endif // STRIDE_COMPILER_PROJECT_KINEMATIC_BLOCKS_HPP
