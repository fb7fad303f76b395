// How a block sees the axis that its own axis follows.
#ifndef STRIDE_RUNTIME_AXIS_MASTER_HPP
#define STRIDE_RUNTIME_AXIS_MASTER_HPP

#include "runtime/axis/axis_ref.hpp"
#include "runtime/numeric/cam/period.hpp"

#include "st/SM_DriveBasic/SMC_MASTER_STATE.h"

namespace stride::motion {

using MasterState = ::st::SM_DriveBasic::SMC_MASTER_STATE;

/// A master in this cycle: its set values if it is in regulation (bRegulatorOn), else its actual
/// ones (manual, section 5.4).
struct MasterMotion {
  cam::Total position; ///< Over any number of turns since the first look; at that, as shown. [u]
  double velocity;     ///< [u/s]
  double acceleration; ///< [u/s^2]
  double travel;       ///< Since the last look. [u]
};

/// Which values of a master count.
enum class MasterView : uint8_t {
  Auto,   ///< The set values if it is in regulation, else the actual ones.
  Set,    ///< The set values.
  Actual, ///< The actual values.
};

/// The first look at a master.
MasterMotion beginMaster(MasterState &master, axis::AxisRef &ref,
                         MasterView view = MasterView::Auto) noexcept;

/// The next look, one task cycle later. Turns of a rotary master are counted, also several in one
/// cycle: its velocity tells how many. A shift of its zero point (MC_SetPosition) is no motion.
/// When the master changes between set and actual values, or is another one, it is looked at anew
/// with `travel` the way between the two positions.
MasterMotion readMaster(MasterState &master, axis::AxisRef &ref,
                        MasterView view = MasterView::Auto) noexcept;

/// A signal that a program gives instead of a master.
struct Signal {
  double position;     ///< Within the period, if there is one. [u]
  double velocity;     ///< [u/s]
  double acceleration; ///< [u/s^2]
  double period;       ///< 0 for none. [u]
};

/// The first look at a signal.
MasterMotion beginSignal(MasterState &state, const Signal &signal) noexcept;

/// The next look, `cycle` [s] later; turns are counted as those of a master.
MasterMotion readSignal(MasterState &state, const Signal &signal, double cycle) noexcept;

} // namespace stride::motion

#endif
