//! A locked joint keeps the bits of its coordinate across devices and in batches.

use precess_dynamics::Spacecraft;
use precess_dynamics::lanes::Batch;

use super::batch::one_after_another;
use super::locked_gyros::{DT, STEPS, devices, hub, inputs, kept, state};
use super::one_spacecraft_each::printed;

#[test]
fn lanes_keep_locked_coordinates_and_have_the_bits_of_steps() {
    let (inputs, devices) = (inputs::<f64>(), devices());
    let craft = Spacecraft::new(&hub(), &devices).unwrap();
    let mut alone = state();
    let in_order = one_after_another(&craft);
    let mut side_by_side = state();
    for _ in 0..STEPS {
        alone = in_order.step(&alone, &inputs, DT).unwrap();
        side_by_side = craft.step(&side_by_side, &inputs, DT).unwrap();
    }
    kept("step across devices", &side_by_side.devices);
    assert_eq!(printed(&side_by_side), printed(&alone));

    let batch = Batch::new(&hub(), &devices).unwrap();
    let each = Batch::from_spacecraft(vec![craft; 9]);
    let (mut states, mut ends) = (vec![state(); 9], Vec::new());
    batch.run(&mut states, &inputs, DT, STEPS, &mut ends).unwrap();
    let mut others = vec![state(); 9];
    each.run(&mut others, &inputs, DT, STEPS, &mut ends).unwrap();
    for now in states.iter().chain(&others) {
        kept("run of a batch", &now.devices);
        assert_eq!(printed(now), printed(&alone), "other bits than steps");
    }
}
