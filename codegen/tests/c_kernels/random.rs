//! Random numbers, and spacecraft made of them: plain products and sums, the same on every host.

/// A generator of random numbers (`SplitMix64`).
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Either sign, magnitudes from 1/32 to 32, and now and then a zero of either sign.
    pub(crate) fn number(&mut self) -> f64 {
        let (bits, exponent) = (self.bits(), 1018 + self.bits() % 10);
        let sign = bits & (1 << 63);
        let magnitude = (exponent << 52) | (bits >> 12);
        f64::from_bits(sign | if self.bits().is_multiple_of(32) { 0 } else { magnitude })
    }

    /// Uniform between two bounds.
    pub(crate) fn within(&mut self, low: f64, high: f64) -> f64 {
        let between_one_and_two = f64::from_bits((1023 << 52) | (self.bits() >> 12));
        low + (high - low) * (between_one_and_two - 1.0)
    }

    pub(crate) fn vector(&mut self, largest: f64) -> [f64; 3] {
        [(); 3].map(|()| self.within(-largest, largest))
    }

    /// Six entries of an inertia that some body of about this mass has.
    fn inertia(&mut self, mass: f64) -> [f64; 6] {
        let [xx, yy, zz] = [(); 3].map(|()| mass * self.within(1.0, 1.8));
        let [xy, xz, yz] = self.vector(0.05 * mass);
        [xx, xy, xz, yy, yz, zz]
    }

    /// A rotation, row by row.
    pub(crate) fn rotation(&mut self) -> [f64; 9] {
        let (w, [x, y, z]) = (self.within(0.1, 1.0), self.vector(1.0));
        let s = 2.0 / (w * w + x * x + y * y + z * z);
        [
            1.0 - s * (y * y + z * z),
            s * (x * y - w * z),
            s * (x * z + w * y),
            s * (x * y + w * z),
            1.0 - s * (x * x + z * z),
            s * (y * z - w * x),
            s * (x * z - w * y),
            s * (y * z + w * x),
            1.0 - s * (x * x + y * y),
        ]
    }

    /// A hub, its motion and what acts on it, then its devices, as whole.c reads them: of every
    /// second device the wheel is prescribed.
    pub(crate) fn spacecraft(&mut self, devices: usize) -> Vec<f64> {
        let mass = self.within(100.0, 1000.0);
        let mut numbers = vec![mass];
        numbers.extend(self.vector(1.0));
        numbers.extend(self.inertia(mass));
        for largest in [1.0, 100.0, 10.0] {
            numbers.extend(self.vector(largest));
        }
        for k in 0..devices {
            self.device(k % 2 == 1, &mut numbers);
        }
        numbers
    }

    /// Parameters, joints, motors and modes of a DGVSCMG.
    fn device(&mut self, prescribed: bool, numbers: &mut Vec<f64>) {
        numbers.extend(self.rotation());
        numbers.extend(self.vector(2.0));
        for _ in ["outer gimbal", "inner gimbal"] {
            let mass = self.within(1.0, 20.0);
            numbers.extend(self.vector(0.3));
            numbers.push(mass);
            numbers.extend(self.inertia(mass));
            numbers.extend(self.vector(0.5));
        }
        let mass = self.within(1.0, 20.0);
        numbers.extend([self.within(0.0, 0.01), mass]);
        numbers.extend(self.inertia(0.1 * mass));
        // The wheel has turned for hours.
        for largest in [4.0, 4.0, 16e6, 5.0, 5.0, 600.0, 1.0, 1.0, 1.0] {
            numbers.push(self.within(-largest, largest));
        }
        numbers.extend([1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
        let given = self.within(-1.0, 1.0);
        numbers.extend(if prescribed { [0.0, 1.0, given] } else { [1.0, 0.0, 0.0] });
    }
}
