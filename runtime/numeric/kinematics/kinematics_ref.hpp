// The kinematics of a group, whatever it is: one of the library's (any_kinematics.hpp) or one that
// a program has written. Free of the C++ standard library: linked into every application.
#ifndef STRIDE_RUNTIME_NUMERIC_KINEMATICS_KINEMATICS_REF_HPP
#define STRIDE_RUNTIME_NUMERIC_KINEMATICS_KINEMATICS_REF_HPP

#include "runtime/numeric/kinematics/model.hpp"

namespace stride::kinematics {

inline constexpr int kConfigurationBytes = 16;

/// Which of the ways to take a pose, as its kinematics writes it: nobody else knows what it means,
/// but two of them can be compared.
struct Configuration {
  uint8_t bytes[kConfigurationBytes];

  friend bool operator==(const Configuration &a, const Configuration &b) noexcept {
    return __builtin_memcmp(a.bytes, b.bytes, sizeof a.bytes) == 0;
  }
};

/// The functions behind a KinematicsRef. Joints are as the axes count them: [u] of the axis, which
/// is a degree where it turns.
struct KinematicsTable {
  int (*joints)(const void *kinematics);
  /// Bit i: joint i turns.
  unsigned (*turning)(const void *kinematics);
  Task (*task)(const void *kinematics);
  double (*reach)(const void *kinematics);
  Outcome (*check)(const void *kinematics);
  Outcome (*forward)(const void *kinematics, const double *joints, Frame<double> &tool);
  Outcome (*forwardJets)(const void *kinematics, const Jet<3> *joints, Frame<Jet<3>> &tool);
  Configuration (*configurationOf)(const void *kinematics, const double *joints);
  Outcome (*inverse)(const void *kinematics, const Frame<double> &tool,
                     const Configuration &configuration, const double *reference, double *joints);
  Outcome (*inverseJets)(const void *kinematics, const Frame<Jet<3>> &tool,
                         const Configuration &configuration, const double *reference,
                         Jet<3> *joints);
  double (*distanceFromSingular)(const void *kinematics, const double *joints);
  /// What follows is asked for only where this is true.
  bool (*splits)(const void *kinematics, unsigned &toolAxes);
  Configuration (*placingConfigurationOf)(const void *kinematics, const double *joints);
  Outcome (*place)(const void *kinematics, const Vector<double> &point,
                   const Configuration &configuration, const double *reference, double *joints);
  Outcome (*placeJets)(const void *kinematics, const Vector<Jet<3>> &point,
                       const Configuration &configuration, const double *reference, Jet<3> *joints);
};

/// A kinematics for the time of a call: never kept in a state, since it holds addresses.
class KinematicsRef {
public:
  KinematicsRef(const KinematicsTable &table, const void *kinematics) noexcept
      : table_(&table), kinematics_(kinematics) {}

  [[nodiscard]] int joints() const { return table_->joints(kinematics_); }
  [[nodiscard]] bool turns(int joint) const {
    return (table_->turning(kinematics_) >> static_cast<unsigned>(joint) & 1U) != 0;
  }
  /// Which coordinates of a pose it can choose; the others follow.
  [[nodiscard]] Task task() const { return table_->task(kinematics_); }
  /// A length to measure errors by. [u]
  [[nodiscard]] double reach() const { return table_->reach(kinematics_); }
  /// Done, or what is wrong with its measures, its coupling or its tool.
  [[nodiscard]] Outcome check() const { return table_->check(kinematics_); }

  /// The tool's frame in the machine's.
  Outcome forward(const double *joints, Frame<double> &tool) const {
    return table_->forward(kinematics_, joints, tool);
  }
  Outcome forward(const Jet<3> *joints, Frame<Jet<3>> &tool) const {
    return table_->forwardJets(kinematics_, joints, tool);
  }
  [[nodiscard]] Configuration configurationOf(const double *joints) const {
    return table_->configurationOf(kinematics_, joints);
  }
  /// Joints that bring the tool there; where several turns do, those nearest to `reference` among
  /// what the joints' limits allow. Where nothing else decides (singular poses) a joint stays at
  /// `reference`. What the kinematics cannot choose of the frame is not looked at.
  Outcome inverse(const Frame<double> &tool, const Configuration &configuration,
                  const double *reference, double *joints) const {
    return table_->inverse(kinematics_, tool, configuration, reference, joints);
  }
  /// The same with the first three derivatives by the parameter of the tool's way. They are
  /// infinite or NaN in a singular pose.
  Outcome inverse(const Frame<Jet<3>> &tool, const Configuration &configuration,
                  const double *reference, Jet<3> *joints) const {
    return table_->inverseJets(kinematics_, tool, configuration, reference, joints);
  }
  /// The smallest singular value of the Jacobian (turns in radians, lengths as parts of the reach):
  /// 0 in a singular pose.
  [[nodiscard]] double distanceFromSingular(const double *joints) const {
    return table_->distanceFromSingular(kinematics_, joints);
  }

  /// Whether some axes, the placing ones, bring the tool's point anywhere while others, the tool
  /// axes, stay. `toolAxes`: which these are, as bits; 0: there are none.
  bool splits(unsigned &toolAxes) const { return table_->splits(kinematics_, toolAxes); }
  /// Which of the ways the placing axes take to bring the tool's point where it is, as the tool
  /// axes hold it. Of one that splits, as all below.
  [[nodiscard]] Configuration placingConfigurationOf(const double *joints) const {
    return table_->placingConfigurationOf(kinematics_, joints);
  }
  /// Placing axes that bring the tool's point somewhere [u]; the tool axes are given. As `inverse`.
  Outcome place(const Vector<double> &point, const Configuration &configuration,
                const double *reference, double *joints) const {
    return table_->place(kinematics_, point, configuration, reference, joints);
  }
  /// The same with the first three derivatives. They are infinite or NaN where the placing axes are
  /// in a singular pose.
  Outcome place(const Vector<Jet<3>> &point, const Configuration &configuration,
                const double *reference, Jet<3> *joints) const {
    return table_->placeJets(kinematics_, point, configuration, reference, joints);
  }

private:
  const KinematicsTable *table_;
  const void *kinematics_;
};

} // namespace stride::kinematics

#endif // STRIDE_RUNTIME_NUMERIC_KINEMATICS_KINEMATICS_REF_HPP
