"""The simulated rig: finger, gripper, pad and force layer, calibrated to what is printed."""
