//! How the numbers of a failing case become simpler.

use precess_attack::number::NumberTree;
use proptest::strategy::ValueTree;

/// What is left of a number when a failure needs it to be so.
fn minimised(number: f64, simplest: f64, fails: impl Fn(f64) -> bool) -> f64 {
    let mut tree = NumberTree::new(number, simplest);
    while tree.simplify() {
        while !fails(tree.current()) {
            assert!(tree.complicate());
        }
    }
    tree.current()
}

#[test]
fn failure_keeps_the_digits_it_needs() {
    assert_eq!(minimised(3.456_789, 0.0, |_| true), 0.0);
    assert_eq!(minimised(3.456_789, 0.0, |x| x > 0.5), 1.0);
    assert_eq!(minimised(3.456_789, 0.0, |x| x > 2.0), 3.0);
    assert_eq!(minimised(3.456_789, 0.0, |x| x > 3.4), 3.5);
    assert_eq!(minimised(3.456_789, 0.0, |x| x > 3.456_78 && x < 3.456_791), 3.456_79);
    assert_eq!(minimised(-3.456_789, 0.0, |x| x < 0.0), -1.0);
    assert!(minimised(f64::NAN, 0.0, f64::is_nan).is_nan());
    assert_eq!(minimised(f64::MAX, 0.0, |x| x > 1e308), f64::MAX);
}
