//! Thumb code read for one thing: where control may go from a function. Encodings are those of the
//! Armv7-M architecture reference manual, A7.7 (B, BL, BLX, BX, LDR, MOV, ADD).

/// Where control goes from an instruction, besides the next one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Flow {
    /// To an address: a call, or a jump that may leave the function.
    To(u32),
    /// To wherever a register or memory says.
    Anywhere,
}

/// Every such instruction of some code; `at` is its address.
pub(super) fn flows(code: &[u8], at: u32) -> Vec<Flow> {
    let mut found = Vec::new();
    let halves: Vec<u16> =
        code.chunks_exact(2).map(|half| u16::from_le_bytes([half[0], half[1]])).collect();
    let (mut index, mut pc) = (0, at.wrapping_add(4));
    while let Some(&first) = halves.get(index) {
        // 11101, 11110 and 11111 begin an instruction of two halves.
        let wide = first >> 11 >= 0b11101;
        let second = if wide { halves.get(index + 1).copied().unwrap_or(0) } else { 0 };
        let flow = if wide { of_two(first, second, pc) } else { of_one(first, pc) };
        found.extend(flow);
        let taken = if wide { 2 } else { 1 };
        index += taken;
        pc = pc.wrapping_add(if wide { 4 } else { 2 });
    }
    found
}

/// Of an instruction of one half.
fn of_one(first: u16, pc: u32) -> Option<Flow> {
    let to = |offset: u32| Some(Flow::To(pc.wrapping_add(offset)));
    match first {
        // B, conditional; 1110 and 1111 are UDF and SVC.
        0xD000..=0xDDFF => to(signed(u32::from(first & 0xFF) << 1, 9)),
        // B.
        0xE000..=0xE7FF => to(signed(u32::from(first & 0x7FF) << 1, 12)),
        // BLX of a register.
        _ if first & 0xFF80 == 0x4780 => Some(Flow::Anywhere),
        // BX of a register but the link register, which returns.
        _ if first & 0xFF80 == 0x4700 && (first >> 3) & 0xF != 14 => Some(Flow::Anywhere),
        // MOV and ADD to the program counter.
        _ if first & 0xFF87 == 0x4687 || first & 0xFF87 == 0x4487 => Some(Flow::Anywhere),
        _ => None,
    }
}

/// Of an instruction of two halves.
fn of_two(first: u16, second: u16, pc: u32) -> Option<Flow> {
    let (high, low) = (u32::from(first), u32::from(second));
    let [s, j1, j2] = [high >> 10 & 1, low >> 13 & 1, low >> 11 & 1];
    let far = || {
        // I1 = not (J1 xor S), I2 = not (J2 xor S).
        let (i1, i2) = (j1 ^ s ^ 1, j2 ^ s ^ 1);
        let offset = s << 24 | i1 << 23 | i2 << 22 | (high & 0x3FF) << 12 | (low & 0x7FF) << 1;
        Some(Flow::To(pc.wrapping_add(signed(offset, 25))))
    };
    if high & 0xF800 == 0xF000 {
        return match low & 0xD000 {
            // BL and B.
            0xD000 | 0x9000 => far(),
            // B, conditional; 111x there are other instructions.
            0x8000 if high >> 7 & 0b111 != 0b111 => {
                let offset =
                    s << 20 | j2 << 19 | j1 << 18 | (high & 0x3F) << 12 | (low & 0x7FF) << 1;
                Some(Flow::To(pc.wrapping_add(signed(offset, 21))))
            }
            _ => None,
        };
    }
    // LDR to the program counter, but from the stack, which returns. TBB and TBH jump forward by a
    // table that the compiler lays into the function itself, and stay within it.
    let loads = high & 0xFF70 == 0xF850 && low >> 12 == 15;
    (loads && high & 0xF != 13).then_some(Flow::Anywhere)
}

/// A number of so many bits with its sign, as a wrapping offset.
fn signed(number: u32, bits: u32) -> u32 {
    let sign = 1_u32 << (bits - 1);
    (number ^ sign).wrapping_sub(sign)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Encodings as an assembler emits them, at 0x1000.
    #[test]
    fn branches_are_read_as_assembled() {
        let cases: [(&[u8], Flow); 8] = [
            // bl 0x1000; b.w 0x1100; bne.w 0x1100; b 0x1000; beq 0x1004
            (&[0xff, 0xf7, 0xfe, 0xff], Flow::To(0x1000)),
            (&[0x00, 0xf0, 0x7e, 0xb8], Flow::To(0x1100)),
            (&[0x40, 0xf0, 0x7e, 0x80], Flow::To(0x1100)),
            (&[0xfe, 0xe7], Flow::To(0x1000)),
            (&[0x00, 0xd0], Flow::To(0x1004)),
            // blx r3; bx r12; ldr pc, [r0]
            (&[0x98, 0x47], Flow::Anywhere),
            (&[0x60, 0x47], Flow::Anywhere),
            (&[0xd0, 0xf8, 0x00, 0xf0], Flow::Anywhere),
        ];
        for (code, flow) in cases {
            assert_eq!(flows(code, 0x1000), [flow], "{code:x?}");
        }
    }

    #[test]
    fn returns_and_arithmetic_go_nowhere() {
        // bx lr; pop {r4, pc}; ldr pc, [sp], #4; vadd.f64 d0, d1, d2; nop
        let code =
            [0x70, 0x47, 0x10, 0xbd, 0x5d, 0xf8, 0x04, 0xfb, 0x31, 0xee, 0x02, 0x0b, 0x00, 0xbf];
        assert_eq!(flows(&code, 0), []);
    }
}
