/* A state effector of Basilisk: the momentum devices of a Precess parameter table on a Basilisk hub.
 *
 * In each evaluation updateEffectorMassProps eliminates the joints of all devices by precess_contributions_of,
 * updateContributions gives Basilisk what is left, and computeDerivatives takes the accelerations of the joints
 * from those of the hub by precess_accelerations_of. Gravity is Basilisk's, uniform over the spacecraft, as for its
 * own effectors. The hub of the table is not used.
 *
 * IEffPrimePntB_B is zero: Basilisk reads it only for the term -I' omega of its own equations, which the contributions
 * already have.
 */
#ifndef PRECESS_STATE_EFFECTOR_H
#define PRECESS_STATE_EFFECTOR_H

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "architecture/_GeneralModuleFiles/sys_model.h"
#include "architecture/messaging/messaging.h"
#include "architecture/msgPayloadDefC/ArrayMotorTorqueMsgPayload.h"
#include "architecture/msgPayloadDefC/RWSpeedMsgPayload.h"
#include "architecture/msgPayloadDefC/VSCMGArrayTorqueMsgPayload.h"
#include "architecture/msgPayloadDefC/VSCMGSpeedMsgPayload.h"
#include "architecture/utilities/avsEigenMRP.h"
#include "architecture/utilities/bskLogging.h"
#include "simulation/dynamics/_GeneralModuleFiles/dynParamManager.h"
#include "simulation/dynamics/_GeneralModuleFiles/stateEffector.h"

#ifndef SWIG
#include <memory>

#include "precessDevices.h"
#endif

/*! @brief Momentum devices of a Precess parameter table on a Basilisk hub */
class PrecessStateEffector : public StateEffector, public SysModel
{
public:
    PrecessStateEffector();
    ~PrecessStateEffector() override = default;

    /*! Reads a parameter table, as `precess export table` writes it */
    void readTable(const std::string &path);
    /*! Coordinate [rad or m] and rate [rad/s or m/s] of a joint at the start; joints count from the hub outwards */
    void setJoint(unsigned int device, unsigned int joint, double coordinate, double rate);
    /*! A joint with a prescribed acceleration [rad/s^2 or m/s^2] instead of a motor torque */
    void prescribeJoint(unsigned int device, unsigned int joint, double acceleration);
    /*! A joint whose rate is zero and stays so */
    void lockJoint(unsigned int device, unsigned int joint);
    /*! Number of devices */
    unsigned int deviceCount() const;
    /*! Number of joints of a device */
    unsigned int jointCount(unsigned int device) const;
    /*! Coordinate [rad or m] of a joint now */
    double coordinate(unsigned int device, unsigned int joint) const;
    /*! Rate [rad/s or m/s] of a joint now */
    double rate(unsigned int device, unsigned int joint) const;

    void Reset(uint64_t CurrentSimNanos) override;
    void UpdateState(uint64_t CurrentSimNanos) override;

    void registerStates(DynParamManager &states) override;
    void linkInStates(DynParamManager &states) override;
    void updateEffectorMassProps(double integTime) override;
    void updateContributions(double integTime, BackSubMatrices &backSubContr, Eigen::MRPd sigma_BN,
                             Eigen::Vector3d omega_BN_B, Eigen::Vector3d g_N) override;
    void computeDerivatives(double integTime, Eigen::Vector3d rDDot_BN_N, Eigen::Vector3d omegaDot_BN_B,
                            Eigen::MRPd sigma_BN) override;
    void updateEnergyMomContributions(double integTime, Eigen::Vector3d &rotAngMomPntCContr_B, double &rotEnergyContr,
                                      Eigen::Vector3d omega_BN_B) override;
    void modifyStates(double integTime) override;
    void writeOutputStateMessages(uint64_t integTimeNanos) override;

    std::string nameOfJointsState; //!< of all coordinates, then all rates, each in the order of devices and joints

    ReadFunctor<ArrayMotorTorqueMsgPayload> motorTorqueInMsg; //!< [N m or N] of each driven joint, in order
    ReadFunctor<VSCMGArrayTorqueMsgPayload> vscmgTorqueInMsg; //!< [N m] of the gimbal and the wheel of each VSCMG
    Message<RWSpeedMsgPayload> speedOutMsg;                   //!< [rad/s, rad] of each wheel, in order
    Message<VSCMGSpeedMsgPayload> vscmgSpeedOutMsg;           //!< [rad/s, rad] of each VSCMG, in order

private:
#ifndef SWIG
    PrecessDevices &devices() const;
    size_t indexOf(unsigned int device, unsigned int joint, const char *what) const;
    template <typename Call> void checked(Call call) const;
    void evaluate(const Eigen::Vector3d &omega_BN_B);
    void copyJoints();

    std::shared_ptr<PrecessDevices> table;
    PrecessContributions found{};
    /* What it was evaluated at; no joints before it is. */
    Eigen::Vector3d omegaOfFound = Eigen::Vector3d::Zero();
    std::vector<PrecessJoint> jointsOfFound;
    Eigen::Vector3d gravity_B = Eigen::Vector3d::Zero();
    Eigen::MatrixXd derivative;
    /* One state: Basilisk's integrator looks each up by its name. */
    StateData *jointsState = nullptr;
    StateData *hubOmega = nullptr;
#endif
};

#endif
