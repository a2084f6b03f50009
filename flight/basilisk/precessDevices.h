/* The devices of a parameter table behind one interface for both versions of the C library's structures: those of
 * version 1 are smaller and faster, those of version 2 have platforms. */
#ifndef PRECESS_DEVICES_H
#define PRECESS_DEVICES_H

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

/* As precess_contributions: what the devices contribute to the equations of the hub, B axes, matrices row by row. */
struct PrecessContributions {
    double forceByLinear[9];
    double forceByAngular[9];
    double momentByAngular[9];
    double force[3];
    double moment[3];
    double mass;
    double firstMoment[3];
    double firstMomentPrime[3];
    double inertia[9];
};

/* What the library rejects, and why. */
class PrecessError : public std::runtime_error
{
    using std::runtime_error::runtime_error;
};

/* A joint: device, number in its device, how it is given. */
struct PrecessJoint {
    enum Mode { Driven, Prescribed, Locked };
    uint32_t device;
    uint32_t joint;
    Mode mode;
    double coordinate; /* rad or m */
    double rate;       /* rad/s or m/s */
    double given;      /* motor torque, N m or N, or prescribed acceleration, rad/s^2 or m/s^2 */

    bool operator==(const PrecessJoint &other) const
    {
        return this->device == other.device && this->joint == other.joint && this->mode == other.mode &&
               this->coordinate == other.coordinate && this->rate == other.rate && this->given == other.given;
    }
};

/* Devices, their joints, and what they contribute. */
class PrecessDevices
{
public:
    virtual ~PrecessDevices() = default;
    std::vector<int32_t> kinds;
    std::vector<PrecessJoint> joints;

    virtual bool hasWheel(size_t device) const = 0;
    /* Whether a device is a gimbal with a wheel. */
    virtual bool isVscmg(size_t device) const = 0;
    virtual void contributions(const double *omega, PrecessContributions &to) = 0;
    /* Accelerations of the joints on a hub with these accelerations, of the angular velocity of the last call. */
    virtual void accelerations(const double *linear, const double *angular, double *to) = 0;
    /* Kinetic energy and angular momentum about B, with B at rest. */
    virtual void energyAndMomentum(const double *omega, double &energy, double *momentum) = 0;
    /* Angles into [-pi, pi], but for joints with a spring. */
    virtual void wrap() = 0;
};

namespace precess_v1 {
std::shared_ptr<PrecessDevices> devices(const std::vector<char> &table, const std::string &name);
}
namespace precess_v2 {
std::shared_ptr<PrecessDevices> devices(const std::vector<char> &table, const std::string &name);
}

#endif
