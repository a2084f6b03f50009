// Hubs with DGVSCMGs, which have no springs, in MuJoCo.
#include <boost/json/src.hpp>

#include "mujoco_smooth.hpp"

int main(int count, char** words) { return run<Smooth<Craft, false>>(count, words); }
