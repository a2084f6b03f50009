/* Precess: steering. From a torque that the hub is to feel to rates of gimbals and accelerations of wheels, and from
 * those to motor torques. Nothing is kept between calls. Devices stand on the hub: PRECESS_ERROR_NO_STEERING with
 * platforms, and with panels that carry one.
 *
 * Values of joints are in [device][joint], as in precess.h, whose rules hold for pointers, codes and faults.
 */
#ifndef PRECESS_STEERING_H
#define PRECESS_STEERING_H

#include "precess.h"

#ifdef __cplusplus
extern "C" {
#endif

#if PRECESS_TABLE_VERSION == 2
#define precess_steering_terms_of precess_steering_terms_of_v2
#define precess_allocate precess_allocate_v2
#define precess_servo_torques_of precess_servo_torques_of_v2
#endif

/* What is commanded of a joint: nothing, and it keeps its rate; its rate, of a gimbal; its acceleration, of a wheel. */
enum { PRECESS_STEER_NOTHING = 0, PRECESS_STEER_RATE = 1, PRECESS_STEER_ACCELERATION = 2 };

/* How the steering matrix Q is inverted, W being the weights: W Q' (Q W Q' + R)^-1. R is 0, PRECESS_ERROR_NO_TORQUE where the
 * joints are singular; lambda reference^2 exp(-mu measure); or that times a matrix of ones on the diagonal and the dither
 * beside it, which leaves singular poses (Wie 2001). */
enum { PRECESS_INVERSE_EXACT = 0, PRECESS_INVERSE_ROBUST = 1, PRECESS_INVERSE_GENERALISED = 2 };

/* The moment about B that the hub exerts on all devices, B axes: sum by_rate q' + sum by_acceleration q'' +
 * inertia omega' + first_moment x r_B'' + gyroscopic. */
typedef struct precess_steering_terms {
    double by_rate[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS][3];         /* N m s, sliding joint N s */
    double by_acceleration[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS][3]; /* kg m^2, sliding joint kg m */
    double momentum[3];     /* angular momentum of the devices about B relative to the hub, kg m^2/s */
    double first_moment[3]; /* of the devices about B, kg m */
    double inertia[9];      /* of the devices about B, kg m^2 */
    double gyroscopic[3];   /* omega x inertia omega, N m */
} precess_steering_terms;

/* A steering law. */
typedef struct precess_steering_law {
    double weight[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS]; /* how readily a joint moves; not below 0 */
    double lower[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS];  /* bounds of the commands, rad/s or rad/s^2 */
    double upper[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS];
    double reference;  /* momentum that makes measures dimensionless: that of a wheel, kg m^2/s; above 0 */
    double lambda;     /* of inverses but the exact one; not below 0 */
    double mu;
    double dither[3];  /* elements 23, 13, 12 of the generalised inverse, each below 1/2 */
    double wheel_mu;   /* weights of PRECESS_STEER_ACCELERATION are times exp(-wheel_mu measure of the rates): wheels help
                          where gimbals are singular (Schaub, Vadali, Junkins 1998); 0: they are as they are */
    int32_t steered[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS]; /* PRECESS_STEER_ */
    int32_t inverse;   /* PRECESS_INVERSE_ */
    int32_t bounded;   /* 1: lower and upper are read; 0: they are not */
} precess_steering_law;

/* What a law commands. */
typedef struct precess_allocation {
    double command[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS]; /* rad/s or rad/s^2; 0 where nothing is commanded */
    double torque_error[3]; /* the torque on the hub that they give less the one that was demanded, N m */
    double measure;         /* det(Q Q') / reference^6 of the joints whose rates are commanded: 0 where they are singular */
    int32_t at_bound;       /* how many commands are at a bound */
    int32_t reserved;       /* 0 */
} precess_allocation;

/* Commands with gains and limits of the motors. A gimbal accelerates by feed_forward + gain (command - rate), a wheel by
 * its command. */
typedef struct precess_servo {
    double command[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS];      /* rad/s or rad/s^2 */
    double feed_forward[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS]; /* rad/s^2 */
    double gain[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS];         /* 1/s */
    double limit[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS];        /* largest torque, N m; not below 0, HUGE_VAL for none */
    int32_t steered[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS];     /* PRECESS_STEER_ */
} precess_servo;

/* What a servo demands of the motors. */
typedef struct precess_servo_torques {
    double motor[PRECESS_MAX_DEVICES][PRECESS_MAX_JOINTS]; /* N m or N; of a joint that is not commanded that of the inputs */
    int32_t limited;  /* how many are at their limit */
    int32_t reserved; /* 0 */
} precess_servo_torques;

/* What the rates and the accelerations of all joints require about B. */
int32_t precess_steering_terms_of(const precess_spacecraft *craft, const precess_state *state,
                                  precess_steering_terms *out, precess_fault *fault);

/* Commands for a torque on the hub (B axes, N m, three doubles) by the devices; what is not commanded is compensated. */
int32_t precess_allocate(const precess_spacecraft *craft, const precess_state *state, const precess_steering_law *law,
                         const double *torque, precess_allocation *out, precess_fault *fault);

/* Motor torques for commands: what prescribed joints need, coupling, imbalance, springs and friction included. To apply
 * them, drive the joints: copy them to the inputs. */
int32_t precess_servo_torques_of(const precess_spacecraft *craft, const precess_state *state,
                                 const precess_inputs *inputs, const precess_servo *servo,
                                 precess_servo_torques *out, precess_fault *fault);

#ifdef __cplusplus
}
#endif

#endif
