// What kinematics is made of, for all that includes it.
#include <Eigen/Core>
#include <Eigen/Geometry>
