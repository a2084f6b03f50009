// The spacecraft in Pinocchio: a free-flyer and a chain of three revolute joints a device.
#pragma once

#include <pinocchio/multibody.hpp>

#include "craft.hpp"

inline Eigen::Vector3d vector(const Components& x) { return {x[0], x[1], x[2]}; }

inline void add_body(pinocchio::Model& model, pinocchio::JointIndex joint, const Body& body) {
  const auto& i = body.inertia;
  Eigen::Matrix3d tensor;
  tensor << i[0], i[1], i[2], i[1], i[3], i[4], i[2], i[4], i[5];
  model.appendBodyToJoint(joint, pinocchio::Inertia(body.mass, vector(body.centre), tensor),
                          pinocchio::SE3::Identity());
}

inline pinocchio::Model pinocchio_model(const Craft& craft) {
  using namespace pinocchio;
  Model model;
  model.gravity.setZero();
  const JointIndex base = model.addJoint(0, JointModelFreeFlyer(), SE3::Identity(), "B");
  add_body(model, base, craft.hub);
  const std::array<JointModel, 3> joints{JointModelRZ(), JointModelRY(), JointModelRX()};
  for (const Device& device : craft.devices) {
    using RowByRow = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    const Eigen::Matrix3d mount = Eigen::Map<const RowByRow>(device.mount.data());
    JointIndex parent = base;
    for (std::size_t k = 0; k < 3; ++k) {
      const Link& link = device.links[k];
      const Eigen::Matrix3d axes = k == 0 ? mount : Eigen::Matrix3d::Identity();
      const SE3 place(axes, axes * vector(link.origin));
      parent = model.addJoint(parent, joints[k], place, "joint " + std::to_string(model.njoints));
      add_body(model, parent, link.body);
    }
  }
  return model;
}
