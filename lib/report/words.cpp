#include "lib/report/words.hpp"

#include <algorithm>
#include <iterator>

namespace taut::host {
namespace {

constexpr Translation table[] = {
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
    {"States of the joints over time", "各节点状态时程", "Zustände der Knoten über die Zeit"},
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
    {"joint {1} at {2}", "{2} 处的节点 {1}", "Knoten {1} bei {2}"},
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
    {"joint sticks", "节点粘着", "Knoten haftet"},
    {"slides to the end of the cable", "向索的终端滑动", "gleitet zum Ende des Seils"},
    {"slides to its start", "向索的始端滑动", "gleitet zu seinem Anfang"},
    {"per cent at a joint: how much of friction is used there, by a strut that leans or by sliding, at the "
     "end",
     "节点旁的百分数：结束时该处因撑杆倾斜或滑动所用去的摩擦",
     "Prozent an einem Knoten: wie viel der Reibung dort am Ende verbraucht ist, durch einen geneigten Stab "
     "oder durch Gleiten"},
    {"States of the joints of cable {1} over time", "索 {1} 各节点状态时程",
     "Zustände der Knoten von Seil {1} über die Zeit"},
    {"joint, node", "节点编号、名称", "Knoten, Name"},
    {"joint {1} at node {2}", "节点 {1}（{2}）", "Knoten {1} an {2}"},
    {"stick: nothing moves over the joint", "粘着：索在该处不动",
     "haftet: nichts bewegt sich über den Knoten"},
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
    {"joint {1}", "节点 {1}", "Knoten {1}"},
    {"mu of the scene", "模型的 mu", "mu der Szene"},
    {"the joint", "该节点", "der Knoten"},
    {"all joints", "所有节点", "alle Knoten"},
    {"joint {1} ({2})", "节点 {1}（{2}）", "Knoten {1} ({2})"},
    {"{1}, with its 95 % band", "{1}，及其 95 % 区间", "{1}, mit seinem 95-%-Band"},
    {"other joints", "其余节点", "andere Knoten"},
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
    {"mu of", "mu 属于", "mu von"},
    {"Beforehand", "事先", "Vorher"},
    {"Now", "现在", "Jetzt"},
    {"Learned from", "依据", "Gelernt aus"},
    {"Readings used", "所用读数", "Benutzte Ablesungen"},
    {"Share of what was learned", "所占份额", "Anteil am Gelernten"},
    {"Segment", "索段", "Abschnitt"},
    {"Force", "力", "Kraft"},
    {"Predicted", "预测", "Vorhergesagt"},
    {"Joint at its start", "始端节点", "Knoten am Anfang"},
    {"Joint at its end", "终端节点", "Knoten am Ende"},
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
    {"Witness", "见证", "Zeuge"},
    {"SHA-256 of the files; taut {1}", "文件的 SHA-256；taut {1}", "SHA-256 der Dateien; taut {1}"},
    {"exact", "精确", "exakt"},
    {"by table", "按标定表", "nach Tabelle"},
    {"Instruments", "仪器", "Messgeräte"},
    {"Column", "列", "Spalte"},
    {"Identity", "编号", "Nummer"},
    {"Calibrated", "标定日期", "Kalibriert"},
    {"Certificate", "证书", "Schein"},
    {"Gain ±", "增益 ±", "Faktor ±"},
    {"Zero ±", "零点 ±", "Nullpunkt ±"},
    {"Calibration", "标定", "Kalibrierung"},
    {"on the way", "途中", "unterwegs"},
    {"hold", "持荷", "Halt"},
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
    {"Stroke [mm]", "油缸行程 [mm]", "Weg [mm]"},
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
    {"Wedge set: {1} mm measured", "锚具回缩：实测 {1} mm", "Keilschlupf: {1} mm gemessen"},
    {", {1} mm expected", "，理论 {1} mm", ", {1} mm erwartet"},
    {"{1}: the force at {2} is {3} off the required one", "{1}：{2} 处的力偏离规定值 {3}",
     "{1}: die Kraft bei {2} weicht um {3} von der geforderten ab"},
    {"{1}: the elongation at {2} is {3} off the expected one", "{1}：{2} 处的伸长偏离理论值 {3}",
     "{1}: die Dehnung bei {2} weicht um {3} von der erwarteten ab"},
    {"reference", "基准", "Bezug"},
    {"fails", "不合格", "nein"},
    {"passes", "合格", "ja"},
    {"Losses", "预应力损失", "Verluste"},
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
     "Messdose prüfen (Nullpunkt, Bereich, Sitz), dann die Szene: Winkel an den Knoten, mu und sein sd, "
     "vergessene Knoten."},
    {"Friction is surely outside of what the scene says was known of it.", "摩擦显然超出模型所给的范围。",
     "Die Reibung liegt sicher außerhalb dessen, was die Szene von ihr weiß."},
    {"Look at the joints: dirt, damage, missing grease or liner. If all is well, correct mu and mu_sd in the "
     "scene.",
     "查看节点：污物、损伤、缺润滑或衬垫。若一切正常，修正模型中的 mu 和 mu_sd。",
     "Die Knoten ansehen: Schmutz, Schaden, fehlendes Fett oder Futter. Ist alles gut, mu und mu_sd in der "
     "Szene berichtigen."},
    {"The joint holds back more than its friction allows: it does not slide though it should.",
     "该节点的阻力大于摩擦所允许：本应滑动而未滑动。",
     "Der Knoten hält mehr zurück, als seine Reibung erlaubt: er gleitet nicht, obwohl er müsste."},
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
     "Weiter ziehen, oder nachlassen und wieder ziehen, damit die Kraft über die Knoten kommt; nach einem "
     "schlaffen Seil sehen."},
    {"The load cell at this anchored end was read, but joints between it and the jack stick: the reading "
     "says nothing about mu. Readings taken while the cable slides over all joints are worth more.",
     "读取了该锚固端测力计，但其与千斤顶之间有节点粘着：读数不能说明 mu。索在所有节点滑动时的读数更有价值。",
     "Die Messdose an diesem verankerten Ende wurde gelesen, aber Knoten zwischen ihr und der Presse haften: "
     "die Ablesung sagt nichts über mu. Ablesungen, während das Seil überall gleitet, sind mehr wert."},
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
     "den Knoten, vergessene Knoten, Lasten, mu und sein sd."},
    {"The load cell keeps one value although the load moves. What it shows since then is no measurement.",
     "荷载在变而测力计读数不变。此后的显示不是测量值。",
     "Die Messdose zeigt einen festen Wert, obwohl die Last sich ändert. Was sie seither zeigt, ist keine "
     "Messung."},
    {"Check the cell, its cable and the logger. Leave its fields in the log empty until it reads again.",
     "检查测力计、导线和采集仪。恢复之前记录中该列留空。",
     "Messdose, Kabel und Messgerät prüfen. Ihre Felder im Protokoll leer lassen, bis sie wieder misst."},
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
     "Weiter ziehen, bis das Seil über alle Knoten geglitten ist, oder den Zustand des letzten Besuchs "
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

// What stands in a text for {1} of this pattern; nothing if the text is not one of it.
bool fits(std::string_view text, std::string_view pattern, std::string_view& inner) {
  const std::size_t at = pattern.find("{1}");
  if (at == std::string_view::npos || text.size() + 3 <= pattern.size()) return false;
  const std::string_view before = pattern.substr(0, at), after = pattern.substr(at + 3);
  if (text.substr(0, before.size()) != before || text.substr(text.size() - after.size()) != after)
    return false;
  inner = text.substr(before.size(), text.size() - before.size() - after.size());
  return true;
}

// The reasons of a verdict as Verdict writes them.
constexpr const char* reasons[] = {"nobody knows how {1} came under load (pull on or use --state)",
                                   "the load cell at {1} keeps one value although the load moves",
                                   "the load cell at {1} contradicts the model",
                                   "the stroke at {1} contradicts the model",
                                   "the measured force of {1} contradicts the model",
                                   "the load cell at {1} gives readings that do not belong together",
                                   "{1} does not fit the model"};

}  // namespace

const Translation* begin_of_words() { return std::begin(table); }
const Translation* end_of_words() { return std::end(table); }

std::string Words::operator()(std::string_view english) const {
  const Translation* row = found(english);
  return row == nullptr ? std::string(english) : in(language_, *row);
}

std::string Words::operator()(std::string_view english, std::initializer_list<std::string> texts) const {
  const std::string pattern = (*this)(english);
  std::string text;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const std::size_t number =
        i + 2 < pattern.size() && pattern[i] == '{' && pattern[i + 2] == '}' && pattern[i + 1] > '0'
            ? static_cast<std::size_t>(pattern[i + 1] - '0')
            : 0;
    if (number == 0 || number > texts.size()) {
      text += pattern[i];
      continue;
    }
    text += *(texts.begin() + number - 1);
    i += 2;
  }
  return text;
}

std::string Words::verdict(const std::string& english) const {
  std::string_view rest;
  if (!fits(english, "do not trust: {1}", rest)) return (*this)(english);
  std::string said;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find("; "), rest.size());
    std::string reason(rest.substr(0, end)), translated = reason;
    for (const char* pattern : reasons)
      if (std::string_view inner; fits(reason, pattern, inner)) {
        translated = (*this)(pattern, {std::string(inner)});
        break;
      }
    said += (said.empty() ? "" : "; ") + translated;
    rest.remove_prefix(std::min(end + 2, rest.size()));
  }
  return (*this)("do not trust: {1}", {said});
}

const char* Words::code() const {
  for (const auto& [name, language] : languages)
    if (language == language_) return name;
  return "en";
}

}  // namespace taut::host
