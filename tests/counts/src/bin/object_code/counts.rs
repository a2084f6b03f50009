//! [`Counts`]: what the machine code of one kernel does beside its arithmetic.
//!
//! A kernel is straight-line code: products, sums and reciprocals of parameters and state. What is
//! not such code is an error, so that no loop is counted as one pass.

use std::collections::HashMap;

use iced_x86::{
    Decoder, DecoderOptions, FlowControl, Instruction, InstructionInfoFactory, Mnemonic, OpAccess,
    Register,
};

/// Cycles from inputs to result, as on Intel's cores since Skylake: `uops.info`, checked against
/// the chains that `docs/performance.md` measures.
mod latency {
    /// Products and sums.
    pub(super) const ARITHMETIC: u32 = 4;
    /// Quotients.
    pub(super) const DIVISION: u32 = 14;
    /// From memory to a register, of a number that was stored before, too.
    pub(super) const LOAD: u32 = 5;
    /// Signs and shuffles.
    pub(super) const OTHER: u32 = 1;
}

/// Counts of one kernel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Counts {
    /// Products, sums, quotients of numbers; two of an instruction over two numbers.
    pub(crate) arithmetic: u32,
    /// Instructions that read memory.
    pub(crate) loads: u32,
    /// Instructions that write memory.
    pub(crate) stores: u32,
    /// Copies and shuffles between registers of numbers.
    pub(crate) copies: u32,
    /// The longest chain of instructions that wait for each other, cycles.
    pub(crate) chain: u32,
}

impl Counts {
    /// Counts the instructions of a function.
    pub(crate) fn of_function(code: &[u8]) -> Result<Self, String> {
        let mut counts = Self::default();
        let mut ready = Ready::default();
        let mut factory = InstructionInfoFactory::new();
        for instruction in Decoder::new(64, code, DecoderOptions::NONE) {
            match instruction.flow_control() {
                FlowControl::Next => {}
                FlowControl::Return => break,
                other => return Err(format!("{other:?} at {:#x}", instruction.ip())),
            }
            let info = factory.info(&instruction);
            let (mut reads, mut writes) = (false, false);
            let mut start = 0;
            for register in info.used_registers() {
                if is_read(register.access()) {
                    start = start.max(ready.register(register.register()));
                }
            }
            // The stack is moved by instructions that store no number.
            let numbers = instruction.op_count() > 0
                && !matches!(instruction.mnemonic(), Mnemonic::Push | Mnemonic::Pop);
            for memory in info.used_memory() {
                reads |= numbers && is_read(memory.access());
                writes |= numbers && is_written(memory.access());
            }
            let place = MemoryOperand::of_instruction(&instruction);
            if reads {
                let stored = ready.memory.get(&place).copied().unwrap_or(0);
                start = start.max(stored + latency::LOAD);
            }
            let (operations, cycles) = arithmetic(&instruction);
            let end = start + cycles;
            counts.arithmetic += operations;
            counts.loads += u32::from(reads);
            counts.stores += u32::from(writes);
            counts.copies +=
                u32::from(operations == 0 && !reads && !writes && is_copy(&instruction));
            if writes {
                ready.memory.insert(place, end);
            }
            for register in info.used_registers() {
                if is_written(register.access()) {
                    ready.registers.insert(register.register().full_register(), end);
                }
            }
            counts.chain = counts.chain.max(end);
        }
        Ok(counts)
    }
}

/// When registers and memory have their values, cycles.
#[derive(Default)]
struct Ready {
    registers: HashMap<Register, u32>,
    memory: HashMap<MemoryOperand, u32>,
}

impl Ready {
    fn register(&self, register: Register) -> u32 {
        self.registers.get(&register.full_register()).copied().unwrap_or(0)
    }
}

/// Where an instruction reads or writes memory: base register, index register, displacement.
type Address = (Register, Register, u64);

/// A place in memory. Kernels set no address themselves, so that equal addresses are one place.
#[derive(PartialEq, Eq, Hash)]
struct MemoryOperand(Address);

impl MemoryOperand {
    fn of_instruction(instruction: &Instruction) -> Self {
        let (base, index) = (instruction.memory_base(), instruction.memory_index());
        Self((base, index, instruction.memory_displacement64()))
    }
}

fn is_read(access: OpAccess) -> bool {
    use OpAccess::{CondRead, Read, ReadCondWrite, ReadWrite};
    matches!(access, Read | CondRead | ReadWrite | ReadCondWrite)
}

fn is_written(access: OpAccess) -> bool {
    use OpAccess::{CondWrite, ReadCondWrite, ReadWrite, Write};
    matches!(access, Write | CondWrite | ReadWrite | ReadCondWrite)
}

/// Arithmetic operations of an instruction, and the cycles that its result takes.
fn arithmetic(instruction: &Instruction) -> (u32, u32) {
    use Mnemonic::{Addpd, Addsd, Divpd, Divsd, Movapd, Movaps, Mulpd, Mulsd, Subpd, Subsd};
    match instruction.mnemonic() {
        Addsd | Subsd | Mulsd => (1, latency::ARITHMETIC),
        Addpd | Subpd | Mulpd => (2, latency::ARITHMETIC),
        Divsd => (1, latency::DIVISION),
        Divpd => (2, latency::DIVISION),
        // Registers are renamed, and memory has its own latency.
        Movapd | Movaps | Mnemonic::Movsd | Mnemonic::Movupd | Mnemonic::Movups | Mnemonic::Mov => {
            (0, 0)
        }
        _ => (0, latency::OTHER),
    }
}

/// Whether an instruction moves numbers between registers.
fn is_copy(instruction: &Instruction) -> bool {
    use Mnemonic::{Movapd, Movaps, Movhlps, Movlhps, Movsd, Shufpd, Unpckhpd, Unpcklpd};
    matches!(
        instruction.mnemonic(),
        Movapd | Movaps | Movhlps | Movlhps | Movsd | Shufpd | Unpckhpd | Unpcklpd
    )
}
