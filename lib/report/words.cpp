#include "lib/report/words.hpp"

#include <algorithm>
#include <iterator>

namespace taut::host {
namespace {

constexpr Translation translations[] = {
    {"Cable forces: {1}", "索力：{1}", "Seilkräfte: {1}"},
    {"scene", "模型", "Szene"},
    {"Scene", "模型", "Szene"},
    {"Log", "记录", "Protokoll"},
    {"Scene {1}, log {2}. Forces and friction estimated by taut report; bands hold the true value with 95 %.",
     "模型 {1}，记录 {2}。索力与摩擦由 taut report 估计；区间以 95 % 的概率包含真值。",
     "Szene {1}, Protokoll {2}. Kräfte und Reibung geschätzt von taut report; Bänder enthalten den wahren "
     "Wert mit 95 %."},
    {"The answer ends before the log does.", "结果在记录结束之前中止。",
     "Das Ergebnis endet vor dem Protokoll."},
    {"{1}. What follows shows the rows before it.", "{1}。以下为此前各行。",
     "{1}. Was folgt, zeigt die Zeilen davor."},
    {"Verdict {1}:", "{1}的判定：", "Urteil {1}:"},
    {", since {1} s", "，自 {1} s 起", ", seit {1} s"},
    {" (in doubt since {1} s)", "（自 {1} s 起存疑）", " (im Zweifel seit {1} s)"},
    {"No row has an answer.", "没有任何一行有结果。", "Keine Zeile hat ein Ergebnis."},
    {"{1} row", "{1} 行", "{1} Zeile"},
    {"{1} rows", "{1} 行", "{1} Zeilen"},
    {"in {1} s", "（{1} s 内）", "in {1} s"},
    {"largest force", "最大索力", "größte Kraft"},
    {"(sd {1}) in {2} at {3} s", "（标准差 {1}），{2}，{3} s 时", "(Std.-Abw. {1}) in {2} bei {3} s"},
    {"{1} of cable {2}", "索 {2} 的{1}", "{1} von Seil {2}"},
    {"of cable {1}", "（索 {1}）", "von Seil {1}"},
    {"(sd {1})", "（标准差 {1}）", "(Std.-Abw. {1})"},
    {"(sd up to {1})", "（标准差不超过 {1}）", "(Std.-Abw. bis {1})"},
    {"no alarm", "无报警", "kein Alarm"},
    {"{1} alarm", "{1} 次报警", "{1} Alarm"},
    {"{1} alarms", "{1} 次报警", "{1} Alarme"},
    {"Structure", "结构", "Tragwerk"},
    {"Structure {1}", "{1}的结构", "Tragwerk {1}"},
    {"at the end of the log", "记录结束时", "am Ende des Protokolls"},
    {"after row {1}", "第 {1} 行之后", "nach Zeile {1}"},
    {"time [s]", "时间 [s]", "Zeit [s]"},
    {"time since {1} [s]", "自 {1} s 起的时间 [s]", "Zeit seit {1} [s]"},
    {"Axonometric projection, seen from the front right and from above.", "轴测图，自右前上方观看。",
     "Axonometrie, gesehen von vorn rechts und von oben."},
    {"Show at", "显示时刻", "Zeige bei"},
    {"Force along the cable {1}", "{1}沿索的力", "Kraft entlang des Seils {1}"},
    {"What was predicted with the friction of the scene is left out: {1}.", "按模型摩擦的预测从略：{1}。",
     "Die Vorhersage mit der Reibung der Szene fehlt: {1}."},
    {"Cable {1}", "索 {1}", "Seil {1}"},
    {"Force over time", "索力时程", "Kraft über die Zeit"},
    {"Friction coefficient over time", "摩擦系数时程", "Reibbeiwert über die Zeit"},
    {"What friction was learned from", "摩擦系数的依据", "Woraus die Reibung gelernt wurde"},
    {"States of the joints over time", "各节点状态时程", "Zustände der Umlenkungen über die Zeit"},
    {"Alarms", "报警", "Alarme"},
    {"Notices", "提示", "Hinweise"},
    {"Values {1}", "{1}的数值", "Werte {1}"},
    {"Remarks", "备注", "Bemerkungen"},
    {"at {1} s", "{1} s 时", "bei {1} s"},
    {"Colours from {1} to {2}", "颜色自 {1} 至 {2}", "Farben von {1} bis {2}"},
    {"segment {1} ({2}–{3})", "第 {1} 索段（{2}–{3}）", "Abschnitt {1} ({2}–{3})"},
    {"The structure {1} with cables coloured by force", "结构 {1}，索按力着色",
     "Das Tragwerk {1}, Seile nach Kraft gefärbt"},
    {"strut {1} ({2}–{3})", "撑杆 {1}（{2}–{3}）", "Stab {1} ({2}–{3})"},
    {", tension", "，受拉", ", Zug"},
    {", compression", "，受压", ", Druck"},
    {"; leans: {1} of friction used", "；倾斜：用去摩擦 {1}", "; neigt sich: {1} der Reibung verbraucht"},
    {"beam {1}", "梁 {1}", "Balken {1}"},
    {"hinge of {1} at node {2}", "{1} 在节点 {2} 处的铰", "Gelenk von {1} am Knoten {2}"},
    {"support {1}: held in {2}", "支座 {1}：约束 {2}", "Lager {1}: gehalten in {2}"},
    {"rotation", "转动", "Drehung"},
    {"rotation about {1}", "绕 {1} 转动", "Drehung um {1}"},
    {"substructure {1} at node {2}", "子结构 {1}，节点 {2}", "Teiltragwerk {1} am Knoten {2}"},
    {"sd", "标准差", "Std.-Abw."},
    {"joint {1} at {2}", "{2} 处的节点 {1}", "Umlenkung {1} bei {2}"},
    {"stick", "粘着", "haftet"},
    {"forward", "向终端滑动", "vorwärts"},
    {"backward", "向始端滑动", "rückwärts"},
    {"open", "松弛", "offen"},
    {"jack at the start of {1}", "{1} 始端的千斤顶", "Presse am Anfang von {1}"},
    {"jack at the end of {1}", "{1} 终端的千斤顶", "Presse am Ende von {1}"},
    {"strut in compression", "受压撑杆", "Stab unter Druck"},
    {"strut in tension", "受拉撑杆", "Stab unter Zug"},
    {"beam", "梁", "Balken"},
    {"hinge of a beam", "梁铰", "Gelenk eines Balkens"},
    {"support", "支座", "Lager"},
    {"substructure", "子结构", "Teiltragwerk"},
    {"jack", "千斤顶", "Presse"},
    {"joint sticks", "节点粘着", "Umlenkung haftet"},
    {"slides to the end of the cable", "向索的终端滑动", "gleitet zum Ende des Seils"},
    {"slides to its start", "向索的始端滑动", "gleitet zu seinem Anfang"},
    {"per cent at a joint: how much of friction is used there, by a strut that leans or by sliding, at the "
     "end",
     "节点旁的百分数：结束时该处因撑杆倾斜或滑动所用去的摩擦",
     "Prozent an einer Umlenkung: wie viel der Reibung dort am Ende verbraucht ist, durch einen geneigten "
     "Stab oder durch Gleiten"},
    {"States of the joints of cable {1} over time", "索 {1} 各节点状态时程",
     "Zustände der Umlenkungen von Seil {1} über die Zeit"},
    {"joint, node", "节点编号、名称", "Umlenkung, Knoten"},
    {"joint {1} at node {2}", "节点 {1}（{2}）", "Umlenkung {1} an Knoten {2}"},
    {"stick: nothing moves over the joint", "粘着：索在该处不动",
     "haftet: nichts bewegt sich über die Umlenkung"},
    {"forward: the cable moves towards its end", "向前：索向其终端移动",
     "vorwärts: das Seil bewegt sich zu seinem Ende"},
    {"backward: the cable moves towards its start", "向后：索向其始端移动",
     "rückwärts: das Seil bewegt sich zu seinem Anfang"},
    {"open: slack on both sides", "松弛：两侧均松", "offen: schlaff auf beiden Seiten"},
    {"95 % band", "95 % 区间", "95-%-Band"},
    {"estimate", "估计值", "Schätzung"},
    {"predicted with the friction of the scene", "按模型摩擦的预测", "Vorhersage mit der Reibung der Szene"},
    {"load cell {1}: {2} at {3} s", "测力计 {1}：{2}，{3} s", "Messdose {1}: {2} bei {3} s"},
    {"last reading of a load cell", "测力计最后读数", "letzte Ablesung einer Messdose"},
    {"Force in the segments of cable {1} {2}", "{2}索 {1} 各段的力",
     "Kraft in den Abschnitten von Seil {1} {2}"},
    {"segment", "索段", "Abschnitt"},
    {"force [{1}]", "力 [{1}]", "Kraft [{1}]"},
    {"{1}, jack load", "{1}，张拉力", "{1}, Pressenkraft"},
    {"{1}, load cell", "{1}，测力计", "{1}, Messdose"},
    {"other segments", "其余索段", "andere Abschnitte"},
    {"alarms, see the table", "报警，见表", "Alarme, siehe Tabelle"},
    {"target", "目标", "Ziel"},
    {"limit", "限值", "Grenze"},
    {"Force in the segments of cable {1} over time", "索 {1} 各段的力时程",
     "Kraft in den Abschnitten von Seil {1} über die Zeit"},
    {"joint {1}", "节点 {1}", "Umlenkung {1}"},
    {"mu of the scene", "模型的 mu", "mu der Szene"},
    {"the joint", "该节点", "die Umlenkung"},
    {"all joints", "所有节点", "alle Umlenkungen"},
    {"joint {1} ({2})", "节点 {1}（{2}）", "Umlenkung {1} ({2})"},
    {"{1}, with its 95 % band", "{1}，及其 95 % 区间", "{1}, mit seinem 95-%-Band"},
    {"other joints", "其余节点", "andere Umlenkungen"},
    {"Friction coefficient of cable {1} over time", "索 {1} 的摩擦系数时程",
     "Reibbeiwert von Seil {1} über die Zeit"},
    {"less than 1 %", "不到 1 %", "unter 1 %"},
    {"{1} {2} times", "{1} {2} 次", "{1} {2}-mal"},
    {"Later, and not listed one by one: {1}.", "其后未逐一列出：{1}。",
     "Später, und nicht einzeln aufgeführt: {1}."},
    {"Peak {1} in segment {2} at {3} s.", "最大值 {1}，第 {2} 索段，{3} s。",
     "Höchstwert {1} in Abschnitt {2} bei {3} s."},
    {"Lowest {1} in segment {2} at {3} s.", "最小值 {1}，第 {2} 索段，{3} s。",
     "Tiefstwert {1} in Abschnitt {2} bei {3} s."},
    {"Rows", "行", "Zeilen"},
    {"Time [s]", "时间 [s]", "Zeit [s]"},
    {"Since {1} [s]", "自 {1} s 起 [s]", "Seit {1} [s]"},
    {"Where", "位置", "Wo"},
    {"What it means", "含义", "Was es bedeutet"},
    {"What to do", "处理", "Was zu tun ist"},
    {"There is none.", "无。", "Es gibt keinen."},
    {"Alarm", "报警", "Alarm"},
    {"Notice", "提示", "Hinweis"},
    {"mu of {1}: {2}, as the scene has it: nothing in the log measured it.",
     "{1} 的 mu：{2}，取自模型：记录中没有测量它的读数。",
     "mu von {1}: {2}, wie die Szene es hat: nichts im Protokoll hat es gemessen."},
    {", {1} from {2} ({3})", "，{1} 来自 {2}（{3}）", ", {1} aus {2} ({3})"},
    {"{1} of that from {2} ({3} reading)", "其中 {1} 来自 {2}（{3} 个读数）",
     "davon {1} aus {2} ({3} Ablesung)"},
    {"{1} of that from {2} ({3} readings)", "其中 {1} 来自 {2}（{3} 个读数）",
     "davon {1} aus {2} ({3} Ablesungen)"},
    {"mu of {1}: {2} beforehand, {3} now; {4}.", "{1} 的 mu：事先 {2}，现在 {3}；{4}。",
     "mu von {1}: vorher {2}, jetzt {3}; {4}."},
    {"mu of", "对象", "mu von"},
    {"Beforehand", "事先", "Vorher"},
    {"Now", "现在", "Jetzt"},
    {"Learned from", "依据", "Gelernt aus"},
    {"Readings used", "所用读数", "Benutzte Ablesungen"},
    {"Share of what was learned", "所占份额", "Anteil am Gelernten"},
    {"Segment", "索段", "Abschnitt"},
    {"Force", "力", "Kraft"},
    {"Predicted", "预测", "Vorhergesagt"},
    {"Joint at its start", "始端节点", "Umlenkung am Anfang"},
    {"Joint at its end", "终端节点", "Umlenkung am Ende"},
    {"State", "状态", "Zustand"},
    {"sd of mu", "mu 的标准差", "Std.-Abw. von mu"},
    {"Contact force", "接触力", "Anpresskraft"},
    {"Friction used", "已用摩擦", "Reibung verbraucht"},
    {"Values of cable {1} {2}", "{2}索 {1} 的数值", "Werte von Seil {1} {2}"},
    {"trust", "可信", "vertrauen"},
    {"do not trust: {1}", "不可信：{1}", "nicht vertrauen: {1}"},
    {"nobody knows how {1} came under load (pull on or use --state)",
     "{1} 如何受力不得而知（继续张拉或使用 --state）",
     "niemand weiß, wie {1} unter Last kam (weiter ziehen oder --state)"},
    {"the wedge at {1} may have held before the log says so", "{1} 的夹片可能早于记录所示锚固",
     "der Keil an {1} hielt vielleicht, bevor das Protokoll es sagt"},
    {"the wedge at {1} may hold though no row has it locked", "{1} 的夹片可能已锚固，但没有任何一行记录",
     "der Keil an {1} hält vielleicht, ohne dass eine Zeile ihn verankert"},
    {"the load cell at {1} is not read", "{1} 的测力计没有读数", "die Messdose an {1} wird nicht gelesen"},
    {"the load cell at {1} keeps one value although the load moves", "{1} 的测力计读数不变而荷载在变",
     "die Messdose bei {1} zeigt einen festen Wert, obwohl die Last sich ändert"},
    {"{1} does not fit the model", "{1} 与模型不符", "{1} passt nicht zum Modell"},
    {"the load cell at {1} contradicts the model", "{1} 的测力计与模型矛盾",
     "die Messdose bei {1} widerspricht dem Modell"},
    {"the stroke at {1} contradicts the model", "{1} 的伸长与模型矛盾",
     "der Weg bei {1} widerspricht dem Modell"},
    {"the measured force of {1} contradicts the model", "{1} 的实测力与模型矛盾",
     "die gemessene Kraft von {1} widerspricht dem Modell"},
    {"the load cell at {1} gives readings that do not belong together", "{1} 的测力计读数前后不一",
     "die Messdose bei {1} liefert Werte, die nicht zusammengehören"},
    {"Stressing record", "张拉记录", "Spannprotokoll"},
    {"Project", "工程", "Projekt"},
    {"Cable", "索", "Seil"},
    {"Drawing", "图号", "Plan"},
    {"Contractor", "施工单位", "Ausführung"},
    {"Date", "日期", "Datum"},
    {"Crew", "班组", "Spanntrupp"},
    {"Witness", "见证人", "Zeuge"},
    {"SHA-256 of the files; taut {1}", "文件的 SHA-256；taut {1}", "SHA-256 der Dateien; taut {1}"},
    {"exact", "精确", "exakt"},
    {"by table", "按标定表", "nach Tabelle"},
    {"Instruments", "仪器", "Messgeräte"},
    {"Column", "列", "Spalte"},
    {"Identity", "编号", "Nummer"},
    {"Calibrated", "标定日期", "Kalibriert"},
    {"Certificate", "证书", "Kalibrierschein"},
    {"Gain ±", "增益 ±", "Faktor ±"},
    {"Zero ±", "零点 ±", "Nullpunkt ±"},
    {"Calibration", "标定", "Kalibrierung"},
    {"on the way", "途中", "unterwegs"},
    {"hold", "持荷", "Haltepunkt"},
    {"turn", "转折", "Umkehr"},
    {"locked off", "锚固", "verankert"},
    {"end", "结束", "Ende"},
    {"was not reached", "未达到", "nicht erreicht"},
    {"{1}: a required stage of {2} was not reached", "{1}：未达到规定的 {2}",
     "{1}: eine geforderte Stufe von {2} wurde nicht erreicht"},
    {"Jack {1}", "千斤顶 {1}", "Presse {1}"},
    {"Stage", "阶段", "Stufe"},
    {"Required", "规定值", "Gefordert"},
    {"Measured", "实测值", "Gemessen"},
    {"Difference", "偏差", "Abweichung"},
    {"Expected [mm]", "理论伸长 [mm]", "Erwartet [mm]"},
    {"Stroke [mm]", "油缸行程 [mm]", "Pressenweg [mm]"},
    {"Net [mm]", "净伸长 [mm]", "Netto [mm]"},
    {"Result", "结论", "Ergebnis"},
    {"Forces may differ by {1} %.", "力的允许偏差 {1} %。", "Kräfte dürfen um {1} % abweichen."},
    {"No stroke was measured.", "未测伸长。", "Es wurde kein Weg gemessen."},
    {"Expected: with the friction and the stiffness of the scene, for the measured force. Net: what the "
     "stroke has grown by since the first stage, and what was expected there. From half of the largest force "
     "on it may differ by {1} %.",
     "理论伸长：按模型的摩擦与刚度及实测力计算。净伸长：自第一阶段起行程的增量加上该阶段的理论伸长。达到最大"
     "力的一半以后允许偏差 {1} %。",
     "Erwartet: mit Reibung und Steifigkeit der Szene, für die gemessene Kraft. Netto: was der Weg seit der "
     "ersten Stufe gewachsen ist, und was dort erwartet war. Ab der halben größten Kraft darf er um {1} % "
     "abweichen."},
    {"Wedge set: {1} mm measured", "锚固回缩：实测 {1} mm", "Keilschlupf: {1} mm gemessen"},
    {", {1} mm expected", "，理论 {1} mm", ", {1} mm erwartet"},
    {"{1}: the force at {2} is {3} off the required one", "{1}：{2} 处的力偏离规定值 {3}",
     "{1}: die Kraft bei {2} weicht um {3} von der geforderten ab"},
    {"{1}: the elongation at {2} is {3} off the expected one", "{1}：{2} 处的伸长偏离理论值 {3}",
     "{1}: der Dehnweg bei {2} weicht um {3} vom erwarteten ab"},
    {"reference", "基准", "Bezug"},
    {"fails", "不合格", "n. i. O."},
    {"passes", "合格", "i. O."},
    {"Losses", "预应力损失", "Spannkraftverluste"},
    {"Largest force", "最大张拉力", "Größte Kraft"},
    {"By friction then", "当时摩擦损失", "Durch Reibung"},
    {"At the jack since", "此后张拉端损失", "Seither an der Presse"},
    {"Mean then", "当时平均力", "Mittel damals"},
    {"Mean now", "现平均力", "Mittel jetzt"},
    {"beyond its limit", "超限", "jenseits der Grenze"},
    {"at its limit", "临界", "an der Grenze"},
    {"within", "限内", "innerhalb"},
    {"{1}: {2} is beyond its limit", "{1}：{2}超限", "{1}: {2} liegt jenseits der Grenze"},
    {"Segment or strut", "索段或撑杆", "Abschnitt oder Stab"},
    {"Target", "目标", "Ziel"},
    {"Limit", "限值", "Grenze"},
    {"Forces after lock-off", "锚固后的力", "Kräfte nach dem Verankern"},
    {"Forces {1}", "{1}的力", "Kräfte {1}"},
    {"Not complete", "不完整", "Nicht vollständig"},
    {"Fails", "不合格", "Nicht bestanden"},
    {"In doubt", "存疑", "Im Zweifel"},
    {"Passes", "合格", "Bestanden"},
    {"Nothing to judge by", "无判定依据", "Kein Maßstab"},
    {"all that was required is within its tolerance", "各项要求均在允许偏差之内",
     "alles Geforderte liegt in seiner Toleranz"},
    {"no required force, stroke, target or limit was given", "未给出规定力、伸长、目标或限值",
     "es gab keine geforderte Kraft, keinen Weg, kein Ziel, keine Grenze"},
    {"Supervision", "监理", "Bauüberwachung"},
    {"Designer", "设计", "Tragwerksplanung"},
    {"name, signature, date", "姓名、签字、日期", "Name, Unterschrift, Datum"},
    {"A reading of the load cell at this jack does not belong to the others. It was left out.",
     "该千斤顶测力计的一个读数与其余不符，已剔除。",
     "Eine Ablesung der Messdose an dieser Presse passt nicht zu den anderen. Sie wurde weggelassen."},
    {"Nothing, if it is rare. If it comes again and again, check the cell, its cable and its sd in the "
     "scene.",
     "偶尔出现无须处理。若反复出现，检查测力计、其导线和模型中的 sd。",
     "Nichts, wenn es selten ist. Kommt es immer wieder: Messdose, ihr Kabel und ihr sd in der Szene "
     "prüfen."},
    {"The load cell at this anchored end contradicts the model by more than five standard deviations.",
     "该锚固端测力计与模型相差超过五倍标准差。",
     "Die Messdose an diesem verankerten Ende widerspricht dem Modell um mehr als fünf "
     "Standardabweichungen."},
    {"Check the cell (zero, range, seat), then the scene: angles at the joints, mu and its sd, forgotten "
     "joints.",
     "检查测力计（零点、量程、安放），再检查模型：节点处角度、mu 及其 sd、遗漏的节点。",
     "Messdose prüfen (Nullpunkt, Bereich, Sitz), dann die Szene: Winkel an den Umlenkungen, mu und sein "
     "sd, vergessene Umlenkungen."},
    {"Friction is surely outside of what the scene says was known of it.", "摩擦显然超出模型所给的范围。",
     "Die Reibung liegt sicher außerhalb dessen, was die Szene von ihr weiß."},
    {"Look at the joints: dirt, damage, missing grease or liner. If all is well, correct mu and mu_sd in the "
     "scene.",
     "查看节点：污物、损伤、缺润滑或衬垫。若一切正常，修正模型中的 mu 和 mu_sd。",
     "Die Umlenkungen ansehen: Schmutz, Schaden, fehlendes Fett oder Futter. Ist alles gut, mu und mu_sd in "
     "der Szene berichtigen."},
    {"The joint holds back more than its friction allows: it does not slide though it should.",
     "该节点的阻力大于摩擦所允许：本应滑动而未滑动。",
     "Die Umlenkung hält mehr zurück, als ihre Reibung erlaubt: das Seil gleitet dort nicht, obwohl es "
     "müsste."},
    {"Look whether the cable is caught or clamped there before pulling on.",
     "继续张拉之前查看索是否在此处被卡住或夹住。",
     "Vor dem Weiterziehen nachsehen, ob das Seil dort hängt oder klemmt."},
    {"Since the jack last reversed or was locked, its stroke has grown by more or less than computed, beyond "
     "the tolerance (5 %) and the noise of its readings.",
     "自千斤顶上次换向或锚固以来，其行程增量与计算值之差超出允许偏差（5 %）和读数噪声。",
     "Seit die Presse zuletzt umgekehrt oder verankert wurde, ist ihr Weg um mehr oder weniger als berechnet "
     "gewachsen, über die Toleranz (5 %) und das Rauschen hinaus."},
    {"Stop and find the reason before pulling on: slipping wedges, a broken wire, slack, wrong E, A or "
     "lengths.",
     "停止并查明原因后再张拉：夹片滑移、断丝、松弛、E、A 或长度有误。",
     "Anhalten und den Grund finden, bevor weiter gezogen wird: rutschende Keile, Drahtbruch, Schlaffheit, "
     "falsches E, A oder Längen."},
    {"The force in this segment is above its limit, or has not come back from there by 1 % of it.",
     "该索段的力超过上限，或尚未回落上限的 1 %。",
     "Die Kraft in diesem Abschnitt liegt über ihrer Grenze oder ist noch nicht um 1 % zurück."},
    {"Stop pulling; release until it is below the limit.", "停止张拉；放松至限值以下。",
     "Nicht weiter ziehen; nachlassen, bis sie unter der Grenze liegt."},
    {"The force in this segment is below its limit, or has not come back from there by 1 % of it.",
     "该索段的力低于下限，或尚未回升下限的 1 %。",
     "Die Kraft in diesem Abschnitt liegt unter ihrer Grenze oder ist noch nicht um 1 % zurück."},
    {"Pull on, or release and pull again to bring the force over the joints; look for a slack cable.",
     "继续张拉，或放松后再张拉使力越过节点；检查索是否松弛。",
     "Weiter ziehen, oder nachlassen und wieder ziehen, damit die Kraft über die Umlenkungen kommt; nach "
     "einem schlaffen Seil sehen."},
    {"The load cell at this anchored end was read, but joints between it and the jack stick: the reading "
     "says nothing about mu. Readings taken while the cable slides over all joints are worth more.",
     "读取了该锚固端测力计，但其与千斤顶之间有节点粘着：读数不能说明 mu。索在所有节点滑动时的读数更有价值。",
     "Die Messdose an diesem verankerten Ende wurde gelesen, aber Umlenkungen zwischen ihr und der Presse "
     "haften: die Ablesung sagt nichts über mu. Ablesungen, während das Seil überall gleitet, sind mehr "
     "wert."},
    {"Nothing.", "无须处理。", "Nichts."},
    {"The measured force of this strut or segment contradicts the model by more than five standard "
     "deviations.",
     "该撑杆或索段的实测力与模型相差超过五倍标准差。",
     "Die gemessene Kraft dieses Stabs oder Abschnitts widerspricht dem Modell um mehr als fünf "
     "Standardabweichungen."},
    {"Check the gauge (zero, temperature, bending of the strut), then the scene: loads, areas, mu and its "
     "sd.",
     "检查应变计（零点、温度、撑杆弯曲），再检查模型：荷载、面积、mu 及其 sd。",
     "Messung prüfen (Nullpunkt, Temperatur, Biegung des Stabs), dann die Szene: Lasten, Flächen, mu und "
     "sein sd."},
    {"The readings of the load cell at this anchored end are off what the model says for longer than chance "
     "allows. The forces of this cable are in doubt.",
     "该锚固端测力计读数偏离模型的时间之长已非偶然。该索的力存疑。",
     "Die Ablesungen der Messdose an diesem verankerten Ende weichen länger vom Modell ab, als der Zufall "
     "erlaubt. Die Kräfte dieses Seils sind zweifelhaft."},
    {"Compare both cells under one load (gain, zero), then check the scene: angles at the joints, forgotten "
     "joints, loads, mu and its sd.",
     "在同一荷载下比较两个测力计（增益、零点），再检查模型：节点处角度、遗漏的节点、荷载、mu 及其 sd。",
     "Beide Messdosen unter derselben Last vergleichen (Faktor, Nullpunkt), dann die Szene prüfen: Winkel an "
     "den Umlenkungen, vergessene Umlenkungen, Lasten, mu und sein sd."},
    {"The load cell keeps one value although the load moves. What it shows since then is no measurement.",
     "荷载在变而测力计读数不变。此后的显示不是测量值。",
     "Die Messdose zeigt einen festen Wert, obwohl die Last sich ändert. Was sie seither zeigt, ist keine "
     "Messung."},
    {"Check the cell, its cable and the logger. Leave its fields in the log empty until it reads again.",
     "检查测力计、导线和采集仪。恢复之前记录中该列留空。",
     "Messdose, Kabel und Messgerät prüfen. Ihre Felder im Protokoll leer lassen, bis sie wieder misst."},
    {"The load cell of this jack has not been read for long, while rows went on. Its load is taken to be "
     "where it was.",
     "该千斤顶的测力计已久无读数，而记录仍在继续。其荷载按原值计。",
     "Die Messdose dieser Presse wurde lange nicht gelesen, während Zeilen kamen. Ihre Last gilt als die von "
     "zuletzt."},
    {"Check the cell, its plug and the logger. If the pump was worked meanwhile, forces are others.",
     "检查测力计、插头和采集仪。若其间油泵曾工作，则力已不同。",
     "Messdose, Stecker und Messgerät prüfen. Wurde inzwischen gepumpt, sind die Kräfte andere."},
    {"This end was marked as unlocked before its jack pulls what the wedge holds. A wedge cannot come free "
     "before that: it is taken to hold until then.",
     "该端在千斤顶尚未达到夹片所持之力时就被标为解锁。夹片在此之前不会松开：在那之前视为仍然锚固。",
     "Dieses Ende wurde als gelöst gekennzeichnet, bevor seine Presse zieht, was der Keil hält. "
     "Vorher kann ein Keil nicht frei werden: bis dahin gilt er als verankert."},
    {"This end was locked while the load of its jack fell, or when next to none was left. If its wedge held "
     "before the log says so, the forces are those from before the load fell; the intervals reach that far.",
     "该端锚固时千斤顶荷载正在下降，或已所剩无几。若夹片早于记录所示锚固，则力为下降之前的力；区间已延伸至该"
     "力。",
     "Dieses Ende wurde verankert, während die Last seiner Presse fiel oder kaum noch eine da war. Hielt der "
     "Keil, bevor das Protokoll es sagt, so gelten die Kräfte von vor dem Fallen der Last; so weit reichen "
     "die Bänder."},
    {"In the log mark the end as locked from the row on in which its load began to fall, and read it again. "
     "On the device: lock an end before its jack is let out.",
     "在记录中自荷载开始下降的那一行起将该端标为锚固，再重新读取。在设备上：千斤顶回油之前先标记锚固。",
     "Das Ende im Protokoll von der Zeile an als verankert kennzeichnen, in der seine Last zu fallen begann, "
     "und es neu lesen. Am Gerät: ein Ende verankern, bevor seine Presse abgelassen wird."},
    {"The load cell at this anchored end and that of the jack surely differ by more than 1 % of the force. "
     "The intervals hold for it; the forces would be known better if they did not.",
     "该锚固端测力计与千斤顶测力计之差确已超过力的 1 %。区间已计入；若无此差，力会更准。",
     "Die Messdose an diesem verankerten Ende und die der Presse unterscheiden sich sicher um mehr als 1 % "
     "der Kraft. Die Bänder tragen dem Rechnung; ohne das wären die Kräfte besser bekannt."},
    {"Compare both cells under one load, and have the wrong one calibrated.",
     "在同一荷载下比较两个测力计，将有误者送检。",
     "Beide Messdosen unter derselben Last vergleichen und die falsche kalibrieren lassen."},
    {"The cable was under load before the first row, and nobody said how it came there. The interval holds "
     "the forces of every past.",
     "该索在第一行之前已受力，其经过未知。区间包含任何经过下的力。",
     "Das Seil stand vor der ersten Zeile unter Last, und niemand hat gesagt, wie es dazu kam. Das Band "
     "enthält die Kräfte jeder Vergangenheit."},
    {"Pull on until the cable has slid over all joints, or give the state that the last visit left "
     "(--state).",
     "继续张拉至索在所有节点滑动，或给出上次留下的状态（--state）。",
     "Weiter ziehen, bis das Seil über alle Umlenkungen geglitten ist, oder den Zustand des letzten Besuchs "
     "angeben (--state)."},
    {"The jack pulls what this locked end holds: its wedge comes free.",
     "千斤顶拉起了已锚固端所承受的力：其夹片松脱。",
     "Die Presse zieht, was dieses verankerte Ende hält: der Keil löst sich."},
    {"Unlock the end in the log from here on (locked 0), so that the jack drives it again.",
     "自此在记录中解除锚固（locked 0），使千斤顶重新驱动该端。",
     "Das Ende im Protokoll von hier an lösen (locked 0), damit die Presse es wieder führt."},
    {"No row comes from the line. What is shown is the last that was known.",
     "线路没有数据到来。所示为最后已知值。",
     "Von der Leitung kommt keine Zeile. Gezeigt wird das zuletzt Bekannte."},
    {"Check the cable, its plugs and the logger. The line is opened again as soon as it is there.",
     "检查导线、插头和采集仪。线路恢复后将自动重新打开。",
     "Kabel, Stecker und Messgerät prüfen. Die Leitung wird wieder geöffnet, sobald sie da ist."},
    {"A line came that is no row of the log. It was left out.", "收到一行不是记录的数据，已剔除。",
     "Es kam eine Zeile, die keine des Protokolls ist. Sie wurde weggelassen."},
    {"Nothing, if it is rare. If it comes again and again, check baud, plugs and the logger.",
     "偶尔出现无须处理。若反复出现，检查波特率、插头和采集仪。",
     "Nichts, wenn es selten ist. Kommt es immer wieder: Baudrate, Stecker und Messgerät prüfen."},
    {": ", "：", ": "},
    {"{1}; {2}", "{1}；{2}", "{1}; {2}"},
    {"{1}, {2}", "{1}、{2}", "{1}, {2}"},
    {"{1}, or {2}", "{1}，或{2}", "{1}, oder {2}"},
    {"{1}: {2}; {3}", "{1}：{2}；{3}", "{1}: {2}; {3}"},
    {"{1}: {2}: {3}", "{1}：{2}：{3}", "{1}: {2}: {3}"},
    {"{1}{2}: {3}", "{1}{2}：{3}", "{1}{2}: {3}"},
    {"a node", "某节点", "ein Knoten"},
    {"node {1}", "节点 {1}", "Knoten {1}"},
    {"a cable", "某索", "ein Seil"},
    {"cable {1}", "索 {1}", "Seil {1}"},
    {"strut {1}", "撑杆 {1}", "Stab {1}"},
    {"path node {1} of {2}", "{2} 路径上的第 {1} 个节点", "Wegknoten {1} von {2}"},
    {"segment {1} of {2}", "{2} 的第 {1} 索段", "Abschnitt {1} von {2}"},
    {"joint {1} of {2} at {3}", "{2} 的第 {1} 个节点（{3}）", "Umlenkung {1} von {2} an {3}"},
    {"start of {1}", "{1} 的始端", "Anfang von {1}"},
    {"end of {1}", "{1} 的终端", "Ende von {1}"},
    {"substructure {1}", "子结构 {1}", "Teiltragwerk {1}"},
    {"a load pattern", "某荷载模式", "ein Lastfall"},
    {"load pattern {1}", "荷载模式 {1}", "Lastfall {1}"},
    {"the scene", "模型", "die Szene"},
    {"strut {1} from {2}", "连接{2}的撑杆 {1}", "Stab {1} von {2}"},
    {"friction gives way, and what it held runs away ({1}): the structure would jump to a state far away",
     "摩擦不再能维持平衡，其所约束的构件失稳（{1}）：结构将突跳到相距很远的状态",
     "die Reibung gibt nach, und was sie hielt, weicht aus ({1}): das Tragwerk spränge in einen weit "
     "entfernten Zustand"},
    {"mechanism: when the cable slides over this joint, nothing holds its node",
     "机构：索在该处滑动时，该节点没有任何约束",
     "Mechanismus: wenn das Seil über diese Umlenkung gleitet, hält nichts ihren Knoten"},
    {"condensed, it has a number that is infinite or out of all range", "凝聚后出现无穷大或超出合理范围的数",
     "kondensiert enthält sie eine Zahl, die unendlich oder außerhalb jedes Bereichs ist"},
    {"jammed: the joint states do not settle", "卡死：节点状态无法确定",
     "verklemmt: die Zustände der Umlenkungen finden sich nicht"},
    {"all is well", "一切正常", "alles ist in Ordnung"},
    {"the scene holds more than its capacity", "模型超出容量", "die Szene enthält mehr als vorgesehen"},
    {"a number is not finite", "有一个数不是有限值", "eine Zahl ist nicht endlich"},
    {"a number must be greater than zero", "该数必须大于零", "eine Zahl muss größer als null sein"},
    {"a number must not be negative", "该数不得为负", "eine Zahl darf nicht negativ sein"},
    {"there is no such node", "没有这个节点", "diesen Knoten gibt es nicht"},
    {"a node is used twice", "同一节点用了两次", "ein Knoten kommt zweimal vor"},
    {"neighbouring nodes are at the same point", "相邻节点位于同一点",
     "benachbarte Knoten liegen am selben Punkt"},
    {"a cable needs 2 nodes, a closed one 3", "索至少需要 2 个节点，闭合索至少 3 个",
     "ein Seil braucht 2 Knoten, ein geschlossenes 3"},
    {"the cable folds straight back", "索原路折回", "das Seil läuft in sich selbst zurück"},
    {"the supports leave the structure free to move as a rigid body", "支座不足，结构可作刚体运动",
     "die Lager lassen dem Tragwerk eine Starrkörperbewegung"},
    {"the stiffness matrix is not symmetric", "刚度矩阵不对称",
     "die Steifigkeitsmatrix ist nicht symmetrisch"},
    {"the stiffness matrix is not positive semidefinite", "刚度矩阵不是半正定的",
     "die Steifigkeitsmatrix ist nicht positiv semidefinit"},
    {"a value or a reference is out of range", "数值或引用超出范围",
     "ein Wert oder ein Verweis liegt außerhalb des Bereichs"},
    {"the sample holds a number that cannot be used", "该行含有不能使用的数",
     "die Zeile enthält eine Zahl, die nicht brauchbar ist"},
    {"mechanism: nothing holds this node", "机构：该节点没有任何约束",
     "Mechanismus: nichts hält diesen Knoten"},
    {"the cable is pulled through: the jack forces differ by more than all friction",
     "索被整体拉过：两端张拉力之差大于全部摩擦",
     "das Seil wird durchgezogen: die Pressenkräfte unterscheiden sich um mehr als alle Reibung"},
    {"friction gives way: the structure would jump to a state far away",
     "摩擦不再能维持平衡：结构将突跳到相距很远的状态",
     "die Reibung gibt nach: das Tragwerk spränge in einen weit entfernten Zustand"},
    {"under the forces at the target of second-order theory members buckle, and this node moves or turns "
     "most: the target is not reached",
     "在二阶理论目标状态的力作用下构件失稳，该节点位移或转动最大：达不到目标状态",
     "unter den Kräften am Ziel der Theorie zweiter Ordnung knicken Stäbe aus, und dieser Knoten bewegt oder "
     "dreht sich am meisten: das Ziel wird nicht erreicht"},
    {"name a smaller target, make stiffer what is under thrust there (larger I, fewer hinges), or hold it "
     "sideways",
     "请给出较小的目标状态，加大该处受压构件的刚度（增大 I、减少铰），或在侧向约束它",
     "ein kleineres Ziel angeben, was dort gedrückt wird steifer machen (größeres I, weniger Gelenke) oder "
     "seitlich halten"},
    {"look for what next to nothing holds, or for stiffnesses that differ by many powers of ten",
     "请检查几乎没有约束的部分，或相差许多数量级的刚度",
     "nachsehen, was fast nichts hält, oder ob Steifigkeiten sich um viele Zehnerpotenzen unterscheiden"},
    {"the joint states do not settle", "节点状态无法确定", "die Zustände der Umlenkungen finden sich nicht"},
    {"equilibrium is not reached in this precision", "以此精度达不到平衡",
     "in dieser Genauigkeit wird kein Gleichgewicht erreicht"},
    {"start() comes first", "必须先调用 start()", "zuerst kommt start()"},
    {"unknown status", "未知状态", "unbekannter Zustand"},
    {"add a second strut, a support or a substructure at that node", "在该节点增设第二根撑杆、支座或子结构",
     "an diesem Knoten einen zweiten Stab, ein Lager oder ein Teiltragwerk ergänzen"},
    {"make all but one of the jacked ends that pull at it \"anchored\": a jack gives a force, and holds "
     "nothing",
     "把拉住它的张拉端除一个以外都改为 \"anchored\"：千斤顶只给出力，并不固定任何东西",
     "alle gespannten Enden bis auf eines, die daran ziehen, \"anchored\" machen: "
     "eine Presse gibt eine Kraft und hält nichts"},
    {"no strut, beam, cable or substructure ends at it or passes it: remove it from \"nodes\", or connect it",
     "没有撑杆、梁、索或子结构与其相连：从 \"nodes\" 中删去该节点，或将其连接",
     "kein Stab, Balken, Seil oder Teiltragwerk endet dort oder führt darüber: aus \"nodes\" entfernen oder "
     "anschließen"},
    {"add a strut, a support or a substructure that holds it", "增设撑杆、支座或子结构将其约束",
     "einen Stab, ein Lager oder ein Teiltragwerk ergänzen, das ihn hält"},
    {"add a strut, a support or a substructure that holds it, or hold the rotation of a beam that turns "
     "freely",
     "增设撑杆、支座或子结构将其约束，或约束自由转动的梁的转角",
     "einen Stab, ein Lager oder ein Teiltragwerk ergänzen, das ihn hält, oder die Drehung eines frei "
     "drehenden Balkens halten"},
    {"bring the jack forces closer together, or anchor one end", "减小两端张拉力之差，或锚固一端",
     "die Pressenkräfte einander annähern oder ein Ende verankern"},
    {"hold the node of this joint sideways (a second strut, a substructure), or stay below this load",
     "侧向约束该节点（第二根撑杆、子结构），或不超过此荷载",
     "den Knoten dieser Umlenkung seitlich halten (zweiter Stab, Teiltragwerk) oder unter dieser Last "
     "bleiben"},
    {"hold the nodes of these joints sideways, or stay below this load", "侧向约束这些节点，或不超过此荷载",
     "die Knoten dieser Umlenkungen seitlich halten oder unter dieser Last bleiben"},
    {"try taut simulate --method stepwise --substeps 100, or stay below this load",
     "尝试 taut simulate --method stepwise --substeps 100，或不超过此荷载",
     "taut simulate --method stepwise --substeps 100 versuchen oder unter dieser Last bleiben"},
    {"use --scalar double; in double, look for what nothing holds, or for stiffnesses that differ by many "
     "powers of ten",
     "使用 --scalar double；若已是 double，检查没有约束的部分或相差许多数量级的刚度",
     "--scalar double verwenden; in double nach dem suchen, was nichts hält, oder nach Steifigkeiten, die um "
     "viele Zehnerpotenzen auseinanderliegen"},
    {"look for stiffnesses, lengths and forces that differ by very many powers of ten",
     "检查相差极多数量级的刚度、长度和力",
     "nach Steifigkeiten, Längen und Kräften suchen, die um sehr viele Zehnerpotenzen auseinanderliegen"},
    {"write finite numbers, no negative jack forces and no more than the cables can carry",
     "应为有限值，张拉力不得为负，也不得超过索的承载能力",
     "endliche Zahlen schreiben, keine negativen Pressenkräfte und nicht mehr, als die Seile tragen"},
    {"check the scene with: taut check", "用 taut check 检查模型", "die Szene prüfen mit: taut check"},
    {"\"second_order\" in the scene makes the cable's tension count, which may hold it",
     "在模型中加入 \"second_order\" 可计入索的张力，或能将其约束",
     "mit \"second_order\" in der Szene zählt die Zugkraft des Seils, die ihn halten kann"},
    {"{1}: the cable alone holds this node sideways, and without friction {2} runs away; give the joint "
     "friction, or hold its node ({3})",
     "{1}：该节点仅由索侧向约束，无摩擦时{2}失稳；给该处以摩擦，或约束该节点（{3}）",
     "{1}: nur das Seil hält diesen Knoten seitlich, und ohne Reibung weicht {2} aus; der Umlenkung Reibung "
     "geben oder ihren Knoten halten ({3})"},
    {"{1}: between two jacks at work the cable can follow this node, and {2} runs away; prescribe the stroke "
     "of one jack (lock its end, or anchor it), or {3}",
     "{1}：两端千斤顶同时工作时索可随该节点移动，{2}失稳；固定一端的行程（锚固该端），或{3}",
     "{1}: zwischen zwei arbeitenden Pressen kann das Seil diesem Knoten folgen, und {2} weicht aus; den Weg "
     "einer Presse festhalten (ihr Ende verankern) oder {3}"},
    {"the event budget is spent: too many changes between sticking and sliding; add rows in between",
     "事件数超限：粘着与滑动之间转换过多；请在其间增加行",
     "das Ereigniskontingent ist erschöpft: zu viele Wechsel zwischen Haften und Gleiten; Zeilen dazwischen "
     "einfügen"},
    {"the event budget is spent at one load: joints go on changing between sticking and sliding there; stay "
     "below this load",
     "事件数在同一荷载下超限：节点在粘着与滑动之间不断转换；请保持在此荷载以下",
     "das Ereigniskontingent ist bei einer Last erschöpft: Umlenkungen wechseln dort immer weiter zwischen "
     "Haften und Gleiten; unter dieser Last bleiben"},
    {"with --substeps {1} it goes on", "用 --substeps {1} 可以继续", "mit --substeps {1} geht es weiter"},
    {"smaller load steps do not help: try --method tracker", "减小荷载步无效：请用 --method tracker",
     "kleinere Lastschritte helfen nicht: --method tracker versuchen"},
    {"{1}: line {2} (row {3}, time {4} s)", "{1}：第 {2} 行（数据第 {3} 行，时间 {4} s）",
     "{1}: Textzeile {2} (Zeile {3}, Zeit {4} s)"},
    {"{1}, after {2} % of the path to it", "{1}，至该行路径的 {2} % 处", "{1}, nach {2} % des Weges dorthin"},
    {"before the first row", "在第一行之前", "vor der ersten Zeile"},
    {"in row {1}", "在第 {1} 行", "in Zeile {1}"},
    {"it has no answer {1}: {2}", "{1}无解：{2}", "sie hat {1} kein Ergebnis: {2}"},
    {"it has no answer at the end: {1}", "结束时无解：{1}", "sie hat am Ende kein Ergebnis: {1}"},
    {"the log begins under load: until the cables have slid over all joints their forces are those of any "
     "past; --state FILE goes on from the log before",
     "记录开始时已有荷载：在索滑过所有节点之前，其力可为任何经过所致；--state FILE 可接续上一份记录",
     "das Protokoll beginnt unter Last: bis die Seile über alle Umlenkungen geglitten sind, gelten ihre "
     "Kräfte für jede Vergangenheit; --state FILE setzt das vorige Protokoll fort"},
    {"no load cell is read that tells of the jacks: nothing is known of the forces until one is; "
     "--state FILE goes on from the log before",
     "没有能说明千斤顶力的测力计读数：在读到之前力为未知；--state FILE 可接续上一份记录",
     "kein Messwert sagt, was die Pressen ziehen: die Kräfte sind unbekannt, bis einer gelesen wird; --state "
     "FILE setzt das vorige Protokoll fort"},
    {"only wedges hold {1}, and no load cell reads what they hold: nothing is known of their forces until a "
     "jack pulls; --state FILE goes on from the log before",
     "{1} 仅由夹片锚固，且没有测力计读取其力：千斤顶张拉之前其力未知；--state FILE 可接续上一份记录",
     "nur Keile halten {1}, und kein Messwert sagt, was sie halten: ihre Kräfte sind unbekannt, bis eine "
     "Presse zieht; --state FILE setzt das vorige Protokoll fort"},
    {"only wedges hold {1} in the first row, and no load cell reads what they hold: they are taken to be "
     "without load; if they were pulled before, --state FILE goes on from the log before",
     "第一行中 {1} 仅由夹片锚固，且没有测力计读取其力：视为无荷载；若此前已张拉，--state FILE "
     "可接续上一份记录",
     "nur Keile halten {1} in der ersten Zeile, und kein Messwert sagt, was sie halten: angenommen ist, dass "
     "keine Last da ist; wurde vorher gespannt, setzt --state FILE das vorige Protokoll fort"},
    {"{1}: {2}: {3}; second-order theory is made for a tenth: beyond it compare with a program for large "
     "displacements",
     "{1}：{2}：{3}；二阶理论适用于十分之一以内：超出时请与大位移程序比较",
     "{1}: {2}: {3}; Theorie zweiter Ordnung ist für ein Zehntel gemacht: darüber mit einem Programm für "
     "große Verschiebungen vergleichen"},
    {"{1}: {2}; second-order theory is made for displacements up to a fifth of it: beyond it do not trust "
     "its forces, compare with a program for large displacements",
     "{1}：{2}；二阶理论适用于位移不超过该距离五分之一：超出时其力不可信，请与大位移程序比较",
     "{1}: {2}; Theorie zweiter Ordnung ist für Verschiebungen bis zu einem Fünftel davon gemacht: darüber "
     "gelten ihre Kräfte nicht, mit einem Programm für große Verschiebungen vergleichen"},
    {"{1}: {2}; linear theory is made for displacements up to a twentieth of it: beyond it do not trust its "
     "forces, and give the scene \"second_order\"",
     "{1}：{2}；线性理论适用于位移不超过该距离二十分之一：超出时其力不可信，请在场景中写入 \"second_order\"",
     "{1}: {2}; lineare Theorie ist für Verschiebungen bis zu einem Zwanzigstel davon gemacht: darüber "
     "gelten ihre Kräfte nicht, in die Szene gehört dann \"second_order\""},
    {"node {1} has moved by {2} m, and against node {3} by {4} of their distance",
     "节点 {1} 移动了 {2} m，相对节点 {3} 移动了两者距离的 {4}",
     "Knoten {1} hat sich um {2} m verschoben, gegen Knoten {3} um {4} ihres Abstands"},
    {"the cable is bent by {1} less than in the scene", "索的转角比模型中小 {1}",
     "das Seil ist um {1} weniger umgelenkt als in der Szene"},
    {"the cable is bent by {1} more than in the scene", "索的转角比模型中大 {1}",
     "das Seil ist um {1} stärker umgelenkt als in der Szene"},
    {"column {1} is not used: the state began without it", "未使用列 {1}：状态开始时没有该列",
     "Spalte {1} wird nicht benutzt: der Zustand begann ohne sie"},
    {"the log has no column {1}: the factor of this load stays 0", "记录中没有列 {1}：该荷载系数保持为 0",
     "das Protokoll hat keine Spalte {1}: der Faktor dieser Last bleibt 0"},
    {"the drift of mu of cable {1} is not used yet: mu is taken to stay what it is",
     "索 {1} 的摩擦系数漂移尚未使用：视摩擦系数保持不变",
     "die Drift von mu des Seils {1} wird noch nicht benutzt: mu gilt als gleichbleibend"},
    {"the load {1} warms cable {2}, which has no \"alpha\": its temperature changes nothing",
     "荷载 {1} 使索 {2} 升温，而该索没有 \"alpha\"：其温度不起作用",
     "die Last {1} erwärmt Seil {2}, das kein \"alpha\" hat: seine Temperatur bewirkt nichts"},
    {"the log has no column {1}: this jack force stays 0", "记录中没有列 {1}：该张拉力保持为 0",
     "das Protokoll hat keine Spalte {1}: diese Pressenkraft bleibt 0"},
    {"the load of {1} falls from {2} to {3} N after line {4}, and the end is locked in line {5}: "
     "if its wedge was drawn in before, {6} is 1 from line {7} on",
     "{1} 的荷载在第 {4} 行之后从 {2} 降到 {3} N，而该端在第 {5} 行才锚固："
     "如果夹片此前已回缩，则 {6} 应从第 {7} 行起为 1",
     "die Last von {1} fällt nach Zeile {4} von {2} auf {3} N, und das Ende ist erst in Zeile {5} verankert: "
     "wenn sein Keil vorher eingezogen wurde, ist {6} ab Zeile {7} gleich 1"},
    {"the load of {1} falls from {2} N to next to nothing after line {3}, and the end is never locked: "
     "if its wedge was drawn in there, {4} is 1 from line {5} on; if it has none, leave out \"seating\"",
     "{1} 的荷载在第 {3} 行之后从 {2} N 降到几乎为零，而该端从未锚固："
     "如果夹片在那里回缩，则 {4} 应从第 {5} 行起为 1；如果没有夹片，请删去 \"seating\"",
     "die Last von {1} fällt nach Zeile {3} von {2} N auf so gut wie nichts, und das Ende ist nie verankert: "
     "wenn sein Keil dort eingezogen wurde, ist {4} ab Zeile {5} gleich 1; "
     "hat es keinen, \"seating\" weglassen"},
    {"the load {2} N of {1} in line {3} is not used, for the end is locked in that row, and {4} N before: "
     "if the jack pulled it before the wedge was drawn in, give it a row of its own before that",
     "{1} 在第 {3} 行的荷载 {2} N 未被使用，因为该端在此行已锚固，之前为 {4} N："
     "如果千斤顶在夹片回缩前达到该荷载，请在此之前为它单独写一行",
     "die Last {2} N von {1} in Zeile {3} wird nicht benutzt, denn das Ende ist in dieser Zeile verankert, "
     "und {4} N davor: wenn die Presse sie zog, bevor der Keil eingezogen wurde, "
     "ihr davor eine eigene Zeile geben"},
    {"{1} is read {2} s later than {3}, and that is taken off: let the clocks of loggers agree; "
     "if an amplifier averages, write \"lag\": {2} for it",
     "{1} 的读数比 {3} 晚 {2} s，已扣除：请使各记录仪的时钟一致；如果是放大器在求平均，请为它写 \"lag\": {2}",
     "{1} wird {2} s später gelesen als {3}, und das wird abgezogen: die Uhren der Logger gleich stellen; "
     "wenn ein Verstärker mittelt, für ihn \"lag\": {2} schreiben"},
    {"{1} reads {2} N in its first {3} rows, before its load rises: if nothing pulls there, "
     "take that off all of its readings, for forces are off by as much",
     "{1} 在荷载上升之前的前 {3} 行读数为 {2} N："
     "如果那时没有张拉，请从其所有读数中减去该值，否则索力会差这么多",
     "{1} zeigt in seinen ersten {3} Zeilen, bevor die Last steigt, {2} N: wenn dort nichts zieht, "
     "das von allen seinen Werten abziehen, denn um so viel sind Kräfte falsch"},
    {"column {1} is a measurement: simulate does not use it", "列 {1} 是测量值：simulate 不使用",
     "Spalte {1} ist eine Messung: simulate benutzt sie nicht"},
    {"column {1} is a measurement at an anchored end: simulate does not use it",
     "列 {1} 是锚固端的测量值：simulate 不使用",
     "Spalte {1} ist eine Messung an einem verankerten Ende: simulate benutzt sie nicht"},
    {"--substeps has no effect: the method tracker follows a row from event to event, not in steps",
     "--substeps 不起作用：tracker 方法按事件而非按步推进",
     "--substeps hat keine Wirkung: das Verfahren tracker folgt einer Zeile von Ereignis zu Ereignis, nicht "
     "in Schritten"},
    {"{1}: line {2}, column {3} ({4}): the factor {5} is more than the cables can carry; the one before is "
     "kept",
     "{1}：第 {2} 行第 {3} 列（{4}）：系数 {5} 超过索的承载能力；沿用前一个值",
     "{1}: Textzeile {2}, Spalte {3} ({4}): der Faktor {5} ist mehr, als die Seile tragen; der vorige "
     "bleibt"},
    {"{1}: line {2}, column {3} ({4}): the factor {5} is more than the cables can carry, as are perhaps "
     "more; the ones before are kept",
     "{1}：第 {2} 行第 {3} 列（{4}）：系数 {5} 超过索的承载能力，其后可能还有；均沿用前一个值",
     "{1}: Textzeile {2}, Spalte {3} ({4}): der Faktor {5} ist mehr, als die Seile tragen, vielleicht auch "
     "weitere; die vorigen bleiben"},
    {"{1}: line {2} is the header again; it is skipped, and the log goes on below it",
     "{1}：第 {2} 行重复了表头；跳过该行，记录从其下一行继续",
     "{1}: Textzeile {2} ist noch einmal die Kopfzeile; sie wird übersprungen, das Protokoll geht darunter "
     "weiter"},
    {"{1}: line {2} is the header again, as are perhaps more; they are skipped",
     "{1}：第 {2} 行重复了表头，其后可能还有；均予跳过",
     "{1}: Textzeile {2} ist noch einmal die Kopfzeile, vielleicht auch weitere; sie werden übersprungen"},
    {"cable {1} has no \"mu_sd\": half of mu, {2}, is taken for its standard deviation",
     "索 {1} 没有 \"mu_sd\"：以 mu 的一半 {2} 作为其标准差",
     "Seil {1} hat kein \"mu_sd\": die Hälfte von mu, {2}, gilt als Standardabweichung"},
    {"the scene does not say all of the gauge {1} in \"sensors\": \"sd\" {2} N, \"gain_sd\" {3} and "
     "\"zero_sd\" {4} N are taken",
     "模型的 \"sensors\" 对测力仪 {1} 说明不全：取 \"sd\" {2} N、\"gain_sd\" {3}、\"zero_sd\" {4} N",
     "die Szene sagt in \"sensors\" nicht alles über die Messstelle {1}: \"sd\" {2} N, \"gain_sd\" {3} und "
     "\"zero_sd\" {4} N werden angenommen"},
    {"the stroke {1} is not in \"sensors\": \"sd\" 0.001 m and a free zero are taken",
     "\"sensors\" 中没有行程 {1}：取 \"sd\" 0.001 m，零点自由",
     "der Weg {1} steht nicht in \"sensors\": \"sd\" 0.001 m und ein freier Nullpunkt werden angenommen"},
    {"more than {1} load cells: gain and zero that the scene does not say are taken for exact",
     "测力计超过 {1} 个：模型未说明的增益和零点视为精确",
     "mehr als {1} Messdosen: Faktor und Nullpunkt, die die Szene nicht sagt, gelten als exakt"},
    {"the load cell {1} is taken for an ordinary one in what \"sensors\" does not say of it: {2}",
     "\"sensors\" 未说明之处，测力计 {1} 按普通测力计处理：{2}",
     "die Messdose {1} gilt, wo \"sensors\" nichts von ihr sagt, als gewöhnliche: {2}"},
    {"sd {1} N as its readings scatter", "sd {1} N（按其读数的离散）",
     "sd {1} N, wie ihre Ablesungen streuen"},
    {"sd {1} N", "sd {1} N", "sd {1} N"},
    {"gain_sd {1}", "gain_sd {1}", "gain_sd {1}"},
    {"zero_sd {1} N", "zero_sd {1} N", "zero_sd {1} N"},
    {"hysteresis sd {1}", "滞回 sd {1}", "Hysterese sd {1}"},
    {"An alarm that this report has no words for.", "本报告没有说明的报警。",
     "Ein Alarm, für den dieser Bericht keine Worte hat."},
    {"See the description of the alarms.", "见报警说明。", "Siehe die Beschreibung der Alarme."},
};

const char* in(Language language, const Translation& row) {
  switch (language) {
    case Language::english:
      return row.english;
    case Language::chinese:
      return row.chinese;
    case Language::german:
      return row.german;
  }
  return row.english;
}

const Translation* found(std::string_view english) {
  const Translation* row = std::find_if(begin_of_words(), end_of_words(),
                                        [&](const Translation& each) { return english == each.english; });
  return row == end_of_words() ? nullptr : row;
}

}  // namespace

const Translation* begin_of_words() { return std::begin(translations); }
const Translation* end_of_words() { return std::end(translations); }

std::string Words::operator()(std::string_view english) const {
  const Translation* row = found(english);
  return row == nullptr ? std::string(english) : in(language_, *row);
}

std::string Words::operator()(std::string_view english, std::initializer_list<std::string> texts) const {
  return filled((*this)(english), texts);
}

std::string Words::operator()(const Sentence& sentence) const {
  return sentence.said([this](std::string_view english) { return (*this)(english); });
}

const char* Words::code() const {
  for (const auto& [name, language] : languages)
    if (language == language_) return name;
  return "en";
}

}  // namespace taut::host
