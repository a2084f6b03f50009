//! Samples as CSV: one row a sample, one column a number, units in the head.

use precess_dynamics::Mrp;

use crate::history::{History, Sample};

/// What the columns mean, for the help of the command. `*` stands for the rest of a name.
pub(crate) const COLUMNS: &str = "\
Columns of a CSV file (SI units and radians; axes x, y, z; N inertial, B body):
  time_s              time since the start
  r_b_n_n*            position of B, N axes
  r_b_n_dot_n*        its velocity, N axes
  q0 q1 q2 q3         attitude of B as seen from N: quaternion, scalar first
  sigma_*             the same as modified Rodrigues parameters
  omega_b*            angular velocity of the hub, B axes
  device_0_*          first device: angles gamma_o, gamma_i, theta (outer gimbal, inner
                      gimbal, wheel; every turn counted), then their rates
  energy_j            kinetic energy
  work_j              work since the start of motors, force and torque
  throughput_j        integral of the motors' |torque * rate|, the unit of energy drift
  linear_momentum_n*  linear momentum, N axes
  angular_momentum_n* angular momentum about the inertial origin, N axes";

/// The history as a CSV file, numbers in the fewest digits that read back the same.
#[must_use]
pub fn csv<const N: usize>(history: &History<N>) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let rows = std::iter::once(head::<N>()).chain(history.samples.iter().map(row));
    for record in rows {
        // Writing to memory and rows of one length: no error is possible.
        if writer.write_record(&record).is_err() {
            break;
        }
    }
    String::from_utf8(writer.into_inner().unwrap_or_default()).unwrap_or_default()
}

fn head<const N: usize>() -> Vec<String> {
    let mut head: Vec<String> = ["time_s"].map(str::to_owned).to_vec();
    let vector = |head: &mut Vec<String>, name: &str, unit: &str| {
        head.extend(["x", "y", "z"].map(|axis| format!("{name}{axis}{unit}")));
    };
    vector(&mut head, "r_b_n_n", "_m");
    vector(&mut head, "r_b_n_dot_n", "_m_per_s");
    head.extend(["q0", "q1", "q2", "q3", "sigma_1", "sigma_2", "sigma_3"].map(str::to_owned));
    vector(&mut head, "omega_b", "_rad_per_s");
    for n in 0..N {
        let columns = [
            "gamma_o_rad",
            "gamma_i_rad",
            "theta_rad",
            "gamma_o_dot_rad_per_s",
            "gamma_i_dot_rad_per_s",
            "spin_rad_per_s",
        ];
        head.extend(columns.map(|column| format!("device_{n}_{column}")));
    }
    head.extend(["energy_j", "work_j", "throughput_j"].map(str::to_owned));
    vector(&mut head, "linear_momentum_n", "_kg_m_per_s");
    vector(&mut head, "angular_momentum_n", "_kg_m2_per_s");
    head
}

fn row<const N: usize>(sample: &Sample<N>) -> Vec<String> {
    let Sample { time, state, entry } = sample;
    let q = state.attitude;
    let mut row = vec![*time];
    row.extend(&state.r_b_n);
    row.extend(&state.r_b_n_dot);
    row.extend([q.q0, q.q1, q.q2, q.q3]);
    row.extend(&Mrp::from(q).0);
    row.extend(&state.omega);
    for j in &state.devices {
        row.extend([j.gamma_o, j.gamma_i, j.theta, j.gamma_o_dot, j.gamma_i_dot, j.spin]);
    }
    row.extend([entry.energy, entry.work, entry.throughput]);
    row.extend(&entry.linear);
    row.extend(&entry.angular);
    row.iter().map(|number| format!("{number:?}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::{Settings, run};
    use crate::scenario::table1::{Drive, Imbalance, Variant};

    #[test]
    fn every_column_is_explained() {
        let names: Vec<_> = COLUMNS
            .lines()
            .filter_map(|line| line.strip_prefix("  ").and_then(|line| line.get(..20)))
            .flat_map(str::split_whitespace)
            .collect();
        for column in head::<1>() {
            let explained = names.iter().any(|name| match name.strip_suffix('*') {
                Some(start) => column.starts_with(start),
                None => column == *name,
            });
            assert!(explained, "{column}");
        }
    }

    #[test]
    fn every_number_reads_back_the_same() {
        let scenario = Variant { imbalance: Imbalance::Printed, drive: Drive::Wheel200 }.scenario();
        let settings = Settings { duration: 0.01, ..Settings::default() };
        let history = run(&scenario, &settings, &mut |_| {}).expect("Table 1 runs");
        let text = csv(&history);
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let head = reader.headers().expect("a head").clone();
        let column = |name: &str| head.iter().position(|c| c == name).expect("a column");
        let (spin, energy) = (column("device_0_spin_rad_per_s"), column("energy_j"));
        let mut rows = 0;
        for (record, sample) in reader.records().zip(&history.samples) {
            let record = record.expect("a row of the head's length");
            let number = |k: usize| record[k].parse::<f64>().expect("a number");
            assert_eq!(number(0), sample.time);
            assert_eq!(number(spin), sample.state.devices[0].spin);
            assert_eq!(number(energy), sample.entry.energy);
            rows += 1;
        }
        assert_eq!(rows, history.samples.len());
    }
}
