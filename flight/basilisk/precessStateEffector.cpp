/* See precessStateEffector.h. */
#include "precessStateEffector.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>

namespace {

/* Beyond this coordinate, rad, angles are wrapped: sines of large angles cost more. */
constexpr double LARGEST_ANGLE = 1e6;

Eigen::Matrix3d matrix(const double (&rows)[9])
{
    return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows);
}

Eigen::Vector3d vector(const double (&of)[3]) { return Eigen::Map<const Eigen::Vector3d>(of); }

/* Of a parameter table; 0 of what is none. */
uint32_t versionOf(const std::vector<char> &table)
{
    uint32_t version = 0;
    if (table.size() >= 8) {
        std::memcpy(&version, &table[4], sizeof version);
    }
    return version;
}

} // namespace

PrecessStateEffector::PrecessStateEffector()
{
    static int count = 0;
    const std::string own = std::to_string(++count);
    this->nameOfJointsState = "precessJoints" + own;
    this->effProps.IEffPrimePntB_B.setZero();
    this->effProps.mEffDot = 0.0;
}

PrecessDevices &PrecessStateEffector::devices() const
{
    if (!this->table) {
        const_cast<PrecessStateEffector *>(this)->bskLogger.bskError(
            "PrecessStateEffector: no devices; call readTable first");
    }
    return *this->table;
}

/* What the library rejects is an error of Basilisk. */
template <typename Call> void PrecessStateEffector::checked(Call call) const
{
    try {
        call();
    } catch (const PrecessError &error) {
        const_cast<PrecessStateEffector *>(this)->bskLogger.bskError("PrecessStateEffector: %s", error.what());
    }
}

void PrecessStateEffector::readTable(const std::string &path)
{
    if (this->jointsState) {
        this->bskLogger.bskError("PrecessStateEffector: %s: the simulation is initialised; call readTable before that",
                                 path.c_str());
    }
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        this->bskLogger.bskError("PrecessStateEffector: %s cannot be read", path.c_str());
    }
    const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    std::shared_ptr<PrecessDevices> made;
    this->checked([&] {
        made = versionOf(bytes) == 1 ? precess_v1::devices(bytes, path) : precess_v2::devices(bytes, path);
    });
    if (made->joints.empty() || made->joints.size() > MAX_EFF_CNT) {
        this->bskLogger.bskError("PrecessStateEffector: %s has %zu joints; a message is of 1 to %d", path.c_str(),
                                 made->joints.size(), MAX_EFF_CNT);
    }
    this->table = made;
    this->jointsOfFound.clear();
}

size_t PrecessStateEffector::indexOf(unsigned int device, unsigned int joint, const char *what) const
{
    const std::vector<PrecessJoint> &joints = this->devices().joints;
    const auto is = [&](const PrecessJoint &of) { return of.device == device && of.joint == joint; };
    const auto at = std::find_if(joints.begin(), joints.end(), is);
    if (at == joints.end()) {
        const_cast<PrecessStateEffector *>(this)->bskLogger.bskError(
            "PrecessStateEffector: %s: device %u has no joint %u", what, device, joint);
    }
    return static_cast<size_t>(at - joints.begin());
}

void PrecessStateEffector::setJoint(unsigned int device, unsigned int joint, double coordinate, double rate)
{
    PrecessJoint &of = this->devices().joints[this->indexOf(device, joint, "setJoint")];
    of.coordinate = coordinate;
    of.rate = rate;
}

void PrecessStateEffector::prescribeJoint(unsigned int device, unsigned int joint, double acceleration)
{
    PrecessJoint &of = this->devices().joints[this->indexOf(device, joint, "prescribeJoint")];
    of.mode = PrecessJoint::Prescribed;
    of.given = acceleration;
}

void PrecessStateEffector::lockJoint(unsigned int device, unsigned int joint)
{
    this->devices().joints[this->indexOf(device, joint, "lockJoint")].mode = PrecessJoint::Locked;
}

unsigned int PrecessStateEffector::deviceCount() const
{
    return static_cast<unsigned int>(this->devices().kinds.size());
}

unsigned int PrecessStateEffector::jointCount(unsigned int device) const
{
    const std::vector<PrecessJoint> &joints = this->devices().joints;
    const auto is = [&](const PrecessJoint &of) { return of.device == device; };
    return static_cast<unsigned int>(std::count_if(joints.begin(), joints.end(), is));
}

double PrecessStateEffector::coordinate(unsigned int device, unsigned int joint) const
{
    const size_t index = this->indexOf(device, joint, "coordinate");
    return this->jointsState ? this->jointsState->getStateReference().data()[index]
                             : this->devices().joints[index].coordinate;
}

double PrecessStateEffector::rate(unsigned int device, unsigned int joint) const
{
    const size_t index = this->indexOf(device, joint, "rate");
    const size_t count = this->devices().joints.size();
    return this->jointsState ? this->jointsState->getStateReference().data()[count + index]
                             : this->devices().joints[index].rate;
}

void PrecessStateEffector::Reset(uint64_t)
{
    (void)this->devices();
    if (this->motorTorqueInMsg.isLinked() && this->vscmgTorqueInMsg.isLinked()) {
        this->bskLogger.bskError("PrecessStateEffector: motorTorqueInMsg and vscmgTorqueInMsg are both connected; "
                                 "connect one");
    }
}

void PrecessStateEffector::UpdateState(uint64_t)
{
    PrecessDevices &own = this->devices();
    if (this->motorTorqueInMsg.isLinked()) {
        const ArrayMotorTorqueMsgPayload given = this->motorTorqueInMsg();
        size_t next = 0;
        for (PrecessJoint &of : own.joints) {
            if (of.mode == PrecessJoint::Driven) {
                of.given = given.motorTorque[next++];
            }
        }
    }
    if (this->vscmgTorqueInMsg.isLinked()) {
        const VSCMGArrayTorqueMsgPayload given = this->vscmgTorqueInMsg();
        size_t gyro = 0;
        for (PrecessJoint &of : own.joints) {
            if (own.isVscmg(of.device) && of.mode == PrecessJoint::Driven) {
                of.given = of.joint == 0 ? given.gimbalTorque[gyro] : given.wheelTorque[gyro];
            }
            gyro += own.isVscmg(of.device) && of.joint == 1 ? 1 : 0;
        }
    }
}

void PrecessStateEffector::registerStates(DynParamManager &states)
{
    const std::vector<PrecessJoint> &joints = this->devices().joints;
    const auto count = static_cast<uint32_t>(joints.size());
    this->jointsState = states.registerState(2 * count, 1, this->nameOfJointsState);
    /* Angles and rates of wheels and gimbals have no common size. */
    this->jointsState->perComponentErrorControl = true;
    Eigen::MatrixXd at(2 * count, 1);
    for (uint32_t index = 0; index < count; index++) {
        at(index, 0) = joints[index].coordinate;
        at(count + index, 0) = joints[index].rate;
    }
    this->jointsState->setState(at);
    this->derivative.resize(2 * count, 1);
}

void PrecessStateEffector::linkInStates(DynParamManager &states)
{
    this->hubOmega = states.getStateObject(this->stateNameOfOmega);
}

void PrecessStateEffector::copyJoints()
{
    std::vector<PrecessJoint> &joints = this->devices().joints;
    const double *at = this->jointsState->getStateReference().data();
    const double *moving = at + joints.size();
    for (PrecessJoint &of : joints) {
        of.coordinate = *at++;
        of.rate = *moving++;
    }
}

/* Not again where nothing has changed: the end of a step is the start of the next one. */
void PrecessStateEffector::evaluate(const Eigen::Vector3d &omega_BN_B)
{
    this->copyJoints();
    const std::vector<PrecessJoint> &joints = this->devices().joints;
    if (omega_BN_B == this->omegaOfFound && joints == this->jointsOfFound) {
        return;
    }
    this->jointsOfFound.clear();
    this->checked([&] { this->devices().contributions(omega_BN_B.data(), this->found); });
    this->omegaOfFound = omega_BN_B;
    this->jointsOfFound = joints;
}

/* Basilisk calls this first in each evaluation, and once before states are linked. */
void PrecessStateEffector::updateEffectorMassProps(double)
{
    Eigen::Vector3d omega = Eigen::Vector3d::Zero();
    if (this->hubOmega) {
        omega = this->hubOmega->getStateReference();
    }
    this->evaluate(omega);
    const PrecessContributions &of = this->found;
    this->effProps.mEff = of.mass;
    this->effProps.rEff_CB_B = vector(of.firstMoment) / of.mass;
    this->effProps.rEffPrime_CB_B = vector(of.firstMomentPrime) / of.mass;
    this->effProps.IEffPntB_B = matrix(of.inertia);
}

/* Basilisk adds the devices as one rigid body with the properties above; here is the rest. */
void PrecessStateEffector::updateContributions(double, BackSubMatrices &backSubContr, Eigen::MRPd sigma_BN,
                                               Eigen::Vector3d omega_BN_B, Eigen::Vector3d g_N)
{
    if (omega_BN_B != this->omegaOfFound) {
        this->evaluate(omega_BN_B);
    }
    this->gravity_B = sigma_BN.toRotationMatrix().transpose() * g_N;
    const PrecessContributions &of = this->found;
    const Eigen::Vector3d moment = vector(of.firstMoment), &omega = omega_BN_B;
    const Eigen::Matrix3d inertia = matrix(of.inertia);
    Eigen::Matrix3d tilde;
    tilde << 0.0, -moment.z(), moment.y(), moment.z(), 0.0, -moment.x(), -moment.y(), moment.x(), 0.0;
    backSubContr.matrixA = matrix(of.forceByLinear) - of.mass * Eigen::Matrix3d::Identity();
    backSubContr.matrixB = matrix(of.forceByAngular) + tilde;
    backSubContr.matrixC = backSubContr.matrixB.transpose();
    backSubContr.matrixD = matrix(of.momentByAngular) - inertia;
    backSubContr.vecTrans = vector(of.force) + omega.cross(omega.cross(moment)) +
                            2.0 * omega.cross(vector(of.firstMomentPrime)) + backSubContr.matrixA * this->gravity_B;
    backSubContr.vecRot =
        vector(of.moment) + omega.cross(inertia * omega) + backSubContr.matrixC * this->gravity_B;
}

void PrecessStateEffector::computeDerivatives(double, Eigen::Vector3d rDDot_BN_N, Eigen::Vector3d omegaDot_BN_B,
                                              Eigen::MRPd sigma_BN)
{
    const Eigen::Vector3d a = sigma_BN.toRotationMatrix().transpose() * rDDot_BN_N - this->gravity_B;
    PrecessDevices &own = this->devices();
    double *to = this->derivative.data();
    for (const PrecessJoint &of : own.joints) {
        *to++ = of.rate;
    }
    this->checked([&] { own.accelerations(a.data(), omegaDot_BN_B.data(), to); });
    this->jointsState->setDerivative(this->derivative);
}

/* Kinetic energy and angular momentum about B, B at rest, as Basilisk's own effectors give them; potential energy of
 * springs is not counted. */
void PrecessStateEffector::updateEnergyMomContributions(double, Eigen::Vector3d &rotAngMomPntCContr_B,
                                                        double &rotEnergyContr, Eigen::Vector3d omega_BN_B)
{
    this->copyJoints();
    this->checked([&] {
        this->devices().energyAndMomentum(omega_BN_B.data(), rotEnergyContr, rotAngMomPntCContr_B.data());
    });
}

void PrecessStateEffector::modifyStates(double)
{
    const auto count = static_cast<Eigen::Index>(this->devices().joints.size());
    const Eigen::MatrixXd &now = this->jointsState->getStateReference();
    if (now.topRows(count).cwiseAbs().maxCoeff() < LARGEST_ANGLE) {
        return;
    }
    Eigen::MatrixXd at = now;
    this->copyJoints();
    this->checked([&] { this->devices().wrap(); });
    double *to = at.data();
    for (const PrecessJoint &of : this->devices().joints) {
        // An angle that jumped beside a large one would seem to have turned.
        *to = std::abs(*to) < LARGEST_ANGLE ? *to : of.coordinate;
        to++;
    }
    this->jointsState->setState(at);
}

void PrecessStateEffector::writeOutputStateMessages(uint64_t integTimeNanos)
{
    RWSpeedMsgPayload wheels = this->speedOutMsg.zeroMsgPayload;
    VSCMGSpeedMsgPayload gyros = this->vscmgSpeedOutMsg.zeroMsgPayload;
    const PrecessDevices &own = this->devices();
    const double *at = this->jointsState->getStateReference().data();
    const double *moving = at + own.joints.size();
    size_t wheel = 0, gyro = 0;
    for (size_t index = 0; index < own.joints.size(); index++) {
        const PrecessJoint &of = own.joints[index];
        const bool isLast = index + 1 == own.joints.size() || own.joints[index + 1].device != of.device;
        if (!isLast || !own.hasWheel(of.device)) {
            continue;
        }
        wheels.wheelSpeeds[wheel] = moving[index];
        wheels.wheelThetas[wheel++] = at[index];
        if (own.isVscmg(of.device)) {
            gyros.wheelSpeeds[gyro] = moving[index];
            gyros.gimbalAngles[gyro] = at[index - 1];
            gyros.gimbalRates[gyro++] = moving[index - 1];
        }
    }
    this->speedOutMsg.write(&wheels, this->moduleID, integTimeNanos);
    this->vscmgSpeedOutMsg.write(&gyros, this->moduleID, integTimeNanos);
}
