//! What is timed how often, and who takes turns with whom.

use crate::contender::Contender;
use crate::subject::{IMAGING, Subject, VSCMG, WHEELS};

/// The cases of what gives, the rigid hub first.
pub(crate) const FLEXIBLE: [&str; 6] =
    ["rigid", "bearings", "platform", "modes-6", "modes-20", "modes-200"];

/// The cases of derivatives: numbers of DGVSCMGs.
pub(crate) const DERIVATIVES: [&str; 3] = ["1", "4", "16"];

/// Numbers of devices over which the cost per device is compared.
pub(crate) const LINEAR: [usize; 5] = [16, 32, 64, 128, 256];

/// What is timed how often.
pub(crate) struct Plan {
    /// Numbers of devices for everyone.
    pub(crate) counts: &'static [usize],
    /// More of them for Precess, whose curve they draw.
    curve: &'static [usize],
    /// Numbers of devices of which the costs are compared.
    linear: &'static [usize],
    /// Numbers of DGVSCMGs in steps.
    pub(crate) steps: &'static [usize],
    /// Turns of everyone.
    pub(crate) rounds: usize,
}

/// Contenders that take turns: their times are comparable.
pub(crate) struct Heat<'a> {
    pub(crate) title: String,
    /// Who, on which case.
    pub(crate) entries: Vec<(&'a Contender, String)>,
}

impl Plan {
    /// What the page is made of.
    pub(crate) const FULL: Self = Self {
        counts: &[1, 4, 16, 64],
        curve: &[2, 8, 32, 128, 256],
        linear: &LINEAR,
        steps: &[1, 4],
        rounds: 41,
    };
    /// A quick look.
    pub(crate) const QUICK: Self =
        Self { counts: &[1, 4], curve: &[], linear: &[], steps: &[1, 4], rounds: 7 };

    /// The cases of steps, with their titles.
    pub(crate) fn step_cases(&self) -> Vec<(String, String)> {
        let named = [WHEELS, VSCMG].map(|(case, title)| (case.to_owned(), title.to_owned()));
        let counts = self.steps.iter().map(|n| (n.to_string(), format!("DGVSCMGs, N = {n}")));
        named.into_iter().chain(counts).collect()
    }

    /// The cases of a subject.
    pub(crate) fn cases(&self, subject: Subject) -> Vec<String> {
        match subject {
            Subject::Evaluation | Subject::Batch | Subject::Floor => {
                self.counts.iter().map(usize::to_string).collect()
            }
            Subject::Step => self.step_cases().into_iter().map(|(case, _)| case).collect(),
            Subject::BatchStep => vec!["4".to_owned()],
            Subject::Baked => vec![IMAGING.to_owned()],
            Subject::Flexible => FLEXIBLE.map(str::to_owned).to_vec(),
            Subject::Derivatives => DERIVATIVES.map(str::to_owned).to_vec(),
        }
    }

    /// All cases of what gives take turns: they are compared with the rigid hub.
    pub(crate) fn flexible(contenders: &[Contender]) -> Heat<'_> {
        let all = contenders.iter().filter(|who| who.subject == Subject::Flexible);
        let cases = |who| FLEXIBLE.into_iter().map(move |case| (who, case.to_owned()));
        let entries = all.flat_map(cases).filter(|(who, case)| who.takes(case)).collect();
        Heat { title: "what gives".to_owned(), entries }
    }

    /// Everything that is done with one spacecraft takes turns.
    pub(crate) fn derivatives(contenders: &[Contender]) -> Vec<Heat<'_>> {
        let heat = |case: &'static str| {
            let all = contenders.iter().filter(|who| who.subject == Subject::Derivatives);
            let takes = all.filter(|who| who.takes(case));
            let entries = takes.map(|who| (who, case.to_owned())).collect();
            Heat { title: format!("derivatives, {case}"), entries }
        };
        DERIVATIVES.map(heat).into()
    }

    /// Everyone who takes turns.
    pub(crate) fn heats<'a>(&self, contenders: &'a [Contender]) -> Vec<Heat<'a>> {
        let heat = |subjects: &[Subject], case: &str, peers: bool| {
            let takes = |who: &&Contender| {
                subjects.contains(&who.subject) && who.takes(case) && (peers || who.is_ours())
            };
            let entries = contenders.iter().filter(takes).map(|who| (who, case.to_owned()));
            Heat { title: format!("{:?}, {case}", subjects[0]), entries: entries.collect() }
        };
        let evaluations = [Subject::Evaluation, Subject::Batch, Subject::Floor];
        let mut heats: Vec<_> =
            self.counts.iter().map(|n| heat(&evaluations, &n.to_string(), true)).collect();
        for subject in [Subject::Step, Subject::BatchStep, Subject::Baked] {
            heats.extend(self.cases(subject).iter().map(|case| heat(&[subject], case, true)));
        }
        heats.extend(self.curve.iter().map(|n| heat(&evaluations[..2], &n.to_string(), false)));
        let one = contenders.iter().filter(|who| who.serves(Subject::Evaluation.unit()));
        let linear = one.flat_map(|who| self.linear.iter().map(move |n| (who, n.to_string())));
        heats.push(Heat { title: "cost against N".to_owned(), entries: linear.collect() });
        heats
    }
}
